// One surface as it is drawn: triangles and edges at the places that a state has, in the colours that are chosen.

import { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, LineSegments, Mesh, RawShaderMaterial, Vector3, Vector4 } from "three";

const vertexShader = `
precision highp float;
in vec3 position;
in vec3 normal;
in float value;
in vec3 label;
in vec3 own;
in vec2 uv;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform vec3 lower;
uniform vec3 extent;
uniform float largest;
uniform float begin;
uniform vec4 uvBox;
out vec3 place;
out vec3 facing;
out float shown;
out float missing;
out vec3 ownColour;
out vec2 inImage;
flat out vec3 faceColour;
void main() {
    float root = value * (65535.0 / 65534.0);
    missing = value > 0.999993 ? 1.0 : 0.0;
    shown = root * root * largest - begin;
    faceColour = label;
    ownColour = own;
    inImage = uvBox.xy + uv * uvBox.zw;
    facing = mat3(modelViewMatrix) * normal;
    vec4 seen = modelViewMatrix * vec4(lower + position * extent, 1.0);
    place = seen.xyz;
    gl_Position = projectionMatrix * seen;
}`;

const fragmentShader = `
precision highp float;
in vec3 place;
in vec3 facing;
in float shown;
in float missing;
in vec3 ownColour;
in vec2 inImage;
flat in vec3 faceColour;
uniform int mode;
uniform bool smoothly;
uniform sampler2D ramp;
uniform sampler2D image;
uniform vec3 tint;
uniform vec3 plain;
uniform float lines;
uniform float firstLine;
uniform bool fine;
out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    if (smoothly && dot(facing, facing) > 0.01)
        normal = normalize(facing) * (dot(facing, normal) < 0.0 ? -1.0 : 1.0);
    float key = max(dot(normal, normalize(vec3(-0.45, 0.65, 0.75))), 0.0);
    float fill = max(dot(normal, normalize(vec3(0.75, -0.2, 0.5))), 0.0);
    float light = 0.46 + 0.5 * key + 0.2 * fill;
    vec3 base = plain;
    if (mode == 1)
        base = faceColour;
    if (mode == 2)
        base = missing > 0.0 ? vec3(0.5) : texture(ramp, vec2(clamp(shown, 0.0, 1.0) * 0.99609375 + 0.001953125, 0.5)).rgb;
    if (mode == 3)
        base = texture(image, inImage).rgb * tint;
    if (mode == 4)
        base = ownColour;
    float at = (shown - firstLine) * lines;
    float thin = fwidth(at);
    if (lines > 0.0 && missing == 0.0) {
        float off = abs(fract(at + 0.5) - 0.5);
        base *= fine ? mix(1.0, 0.35 + 0.65 * smoothstep(0.5 * thin, 1.5 * thin, off), 1.0 - smoothstep(0.15, 0.4, thin)) : off < 0.07 ? 0.5 : 1.0;
    }
    colour = vec4(min(base * light + 0.06 * pow(key, 24.0), 1.0), 1.0);
}`;

const edgeFragmentShader = `
precision highp float;
uniform vec4 ink;
out vec4 colour;
void main() { colour = vec4(ink.rgb * ink.a, ink.a); }`;

/** An array of the mesh's vertices, as those that are drawn have it. @param vertexOf the vertex that each of these is. */
function spread(numbers, vertexOf, stride) {
    const result = new numbers.constructor(stride * vertexOf.length);
    for (let v = 0; v < vertexOf.length; ++v)
        for (let c = 0; c < stride; ++c)
            result[stride * v + c] = numbers[stride * vertexOf[v] + c];
    return result;
}

/** What the vertices of all layers have in common. @param places in an image, four numbers of 16 bits each, or null. */
export function sharedAttributes(triangles, places) {
    const n = triangles.vertexOf.length;
    return {
        index: new BufferAttribute(triangles.index, 1),
        label: new BufferAttribute(new Uint8Array(4 * n).fill(200), 4, true),
        ...(places && { uv: new BufferAttribute(spread(places, triangles.placeOf, 4), 4, true) }),
    };
}

export class Layer {
    #geometry = new BufferGeometry();
    #edgeGeometry = new BufferGeometry();
    #shared;
    #surface;
    #edges;
    #triangles = null;
    #own = { lower: { value: new Vector3() }, extent: { value: new Vector3() }, largest: { value: 0 } };

    /** @param shared uniforms of all layers. */
    constructor(scene, shared) {
        this.#shared = shared;
        this.#surface = new Mesh(this.#geometry, [this.#surfaceMaterial({})]);
        this.#edges = new LineSegments(this.#edgeGeometry, this.#edgeMaterial(shared));
        for (const object of [this.#surface, this.#edges]) {
            object.frustumCulled = false;
            scene.add(object);
        }
    }

    /** @param own uniforms of one material of the file: image and tint. */
    #surfaceMaterial(own) {
        return new RawShaderMaterial({
            glslVersion: GLSL3,
            vertexShader,
            fragmentShader,
            side: DoubleSide,
            polygonOffset: true,
            polygonOffsetFactor: 1,
            polygonOffsetUnits: 1,
            uniforms: { ...this.#shared, ...this.#own, ...own },
        });
    }

    #edgeMaterial({ ink, uvBox }) {
        return new RawShaderMaterial({
            glslVersion: GLSL3,
            vertexShader,
            fragmentShader: edgeFragmentShader,
            transparent: true,
            premultipliedAlpha: true,
            depthWrite: false,
            uniforms: { ...this.#own, ink, uvBox },
        });
    }

    /** @param materials image and tint of each, as uniforms. */
    setMaterials(materials) {
        this.#surface.material = materials.map((own) => this.#surfaceMaterial(own));
    }

    /** @param triangles see drawableTriangles. @param attributes see sharedAttributes. */
    setTriangles(triangles, { index, ...attributes }) {
        this.#triangles = triangles;
        this.#geometry.setIndex(index);
        this.#geometry.clearGroups();
        (triangles.groups ?? [[0, index.count / 3]]).forEach(([begin, end], material) => this.#geometry.addGroup(3 * begin, 3 * (end - begin), material));
        this.#geometry.deleteAttribute("position");
        this.#geometry.deleteAttribute("normal");
        this.#geometry.deleteAttribute("value");
        this.#geometry.deleteAttribute("own");
        for (const [name, attribute] of Object.entries(attributes))
            this.#geometry.setAttribute(name, attribute);
    }

    /** @param index two vertices for each edge. */
    setEdges(index) {
        this.#edgeGeometry.setIndex(index);
        this.#edgeGeometry.setAttribute("position", this.#geometry.getAttribute("position"));
    }

    #replace(name, all, stride) {
        const old = this.#geometry.getAttribute(name);
        if (old && old.array.length === all.length) {
            old.array.set(all);
            old.needsUpdate = true;
        } else {
            this.#geometry.setAttribute(name, new BufferAttribute(all, stride, true));
        }
    }

    /**
     * @param numbers four of 16 bits for each vertex. @param normals four for each vertex of smooth shading, or null.
     * @param box its lower and upper corner. @param centre, radius of what is in view.
     */
    setPositions(numbers, normals, box, centre, radius) {
        this.#replace("position", spread(numbers, this.#triangles.vertexOf, 4), 4);
        if (normals !== null)
            this.#replace("normal", spread(normals, this.#triangles.smoothOf, 4), 4);
        this.#edgeGeometry.setAttribute("position", this.#geometry.getAttribute("position"));
        this.#own.lower.value.set(...box.lower.map((x, k) => (x - centre[k]) / radius));
        this.#own.extent.value.set(...box.upper.map((x, k) => (x - box.lower[k]) / radius));
    }

    /** @param numbers two of 16 bits for each vertex. @param largest that of the values, in ends of the ramp. */
    setValues(numbers, largest) {
        this.#replace("value", spread(numbers, this.#triangles.vertexOf, 2), 2);
        this.#own.largest.value = largest;
    }

    /** @param colours of the vertices: red, green and blue of each. */
    setColours(colours) {
        this.#replace("own", spread(colours, this.#triangles.vertexOf, 3), 3);
    }

    /** Whether it is drawn, if it has anything to show. */
    show(isShown, hasEdges) {
        const isKnown = isShown && this.#geometry.getAttribute("position") !== undefined;
        this.#surface.visible = isKnown;
        this.#edges.visible = isKnown && hasEdges && this.#edgeGeometry.index !== null;
    }
}

/** What materials take that all layers share; the ink of edges is set for each frame. */
export const inkOfEdges = () => ({ value: new Vector4(0.06, 0.08, 0.1, 0) });
