// The surface in three dimensions. It is drawn when something changes, and only then.

import {
    BufferAttribute, BufferGeometry, DataTexture, DoubleSide, GLSL3, LineSegments, Mesh, PerspectiveCamera,
    RawShaderMaterial, Scene, Vector3, Vector4, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const vertexShader = `
precision highp float;
in vec3 position;
in float value;
in vec3 label;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform vec3 lower;
uniform vec3 extent;
uniform float largest;
out vec3 place;
out float shown;
out float missing;
flat out vec3 faceColour;
void main() {
    float root = value * (65535.0 / 65534.0);
    missing = value > 0.999993 ? 1.0 : 0.0;
    shown = root * root * largest;
    faceColour = label;
    vec4 seen = modelViewMatrix * vec4(lower + position * extent, 1.0);
    place = seen.xyz;
    gl_Position = projectionMatrix * seen;
}`;

const fragmentShader = `
precision highp float;
in vec3 place;
in float shown;
in float missing;
flat in vec3 faceColour;
uniform int mode;
uniform sampler2D ramp;
uniform vec3 plain;
uniform float lines;
out vec4 colour;
void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    float key = max(dot(normal, normalize(vec3(-0.45, 0.65, 0.75))), 0.0);
    float fill = max(dot(normal, normalize(vec3(0.75, -0.2, 0.5))), 0.0);
    float light = 0.46 + 0.5 * key + 0.2 * fill;
    vec3 base = plain;
    if (mode == 1)
        base = faceColour;
    if (mode == 2)
        base = missing > 0.0 ? vec3(0.5) : texture(ramp, vec2(clamp(shown, 0.0, 1.0) * 0.99609375 + 0.001953125, 0.5)).rgb;
    if (lines > 0.0)
        base *= abs(fract(shown * lines + 0.5) - 0.5) < 0.07 ? 0.5 : 1.0;
    colour = vec4(min(base * light + 0.06 * pow(key, 24.0), 1.0), 1.0);
}`;

const edgeFragmentShader = `
precision highp float;
uniform vec4 ink;
out vec4 colour;
void main() { colour = vec4(ink.rgb * ink.a, ink.a); }`;

/** The direction that most meshes of such extents have upwards: along a long one, across a flat one, else z. */
function upwards(extent) {
    const order = [0, 1, 2].sort((a, b) => extent[a] - extent[b]);
    const [thin, middle, long] = order;
    if (extent[long] > 1.6 * extent[middle])
        return long;
    return extent[thin] < 0.6 * extent[middle] ? thin : 2;
}

export class View {
    #renderer;
    #scene = new Scene();
    #camera = new PerspectiveCamera(32, 1, 0.02, 60);
    #controls;
    #geometry = new BufferGeometry();
    #edgeGeometry = new BufferGeometry();
    #surface;
    #edges;
    #centre;
    #radius;
    #halves;
    #meanEdge;
    #up;
    #doubled = new Uint32Array(0);
    #drawing = false;
    #untouched = true;

    /**
     * @param box lower and upper corner of the mesh before the flow, which decides what is in view.
     * @param meanEdge of the mesh, in the same unit.
     * @throws Error without WebGL 2.
     */
    constructor(canvas, box, meanEdge) {
        this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: "high-performance" });
        this.#renderer.setClearAlpha(0);
        this.#centre = box.lower.map((x, k) => 0.5 * x + 0.5 * box.upper[k]);
        const halves = box.lower.map((x, k) => 0.5 * box.upper[k] - 0.5 * x);
        this.#radius = Math.hypot(...halves) || 1;
        this.#halves = halves.map((half) => half / this.#radius);
        this.#meanEdge = meanEdge / this.#radius;
        this.#up = upwards(halves);
        this.#surface = new Mesh(this.#geometry, this.#surfaceMaterial());
        this.#edges = new LineSegments(this.#edgeGeometry, this.#edgeMaterial());
        this.#edges.visible = false;
        for (const object of [this.#surface, this.#edges]) {
            object.frustumCulled = false;
            this.#scene.add(object);
        }
        this.#controls = new OrbitControls(this.#camera, canvas);
        this.#controls.addEventListener("change", () => this.draw());
        this.#controls.addEventListener("start", () => (this.#untouched = false));
        this.#controls.minDistance = 0.05;
        this.#controls.maxDistance = 30;
        this.#controls.listenToKeyEvents(canvas);
        new ResizeObserver(() => this.#resize(canvas)).observe(canvas);
        this.reset();
        this.#resize(canvas);
    }

    #surfaceMaterial() {
        const ramp = new DataTexture(new Uint8Array(4 * 256), 256, 1);
        return new RawShaderMaterial({
            glslVersion: GLSL3,
            vertexShader,
            fragmentShader,
            side: DoubleSide,
            polygonOffset: true,
            polygonOffsetFactor: 1,
            polygonOffsetUnits: 1,
            uniforms: {
                lower: { value: new Vector3() },
                extent: { value: new Vector3() },
                largest: { value: 0 },
                mode: { value: 0 },
                lines: { value: 0 },
                ramp: { value: ramp },
                plain: { value: new Vector3(0.86, 0.87, 0.885) },
            },
        });
    }

    /** Shares the uniforms that say where vertices are. */
    #edgeMaterial() {
        const { lower, extent, largest } = this.#surface.material.uniforms;
        return new RawShaderMaterial({
            glslVersion: GLSL3,
            vertexShader,
            fragmentShader: edgeFragmentShader,
            transparent: true,
            premultipliedAlpha: true,
            depthWrite: false,
            uniforms: { lower, extent, largest, ink: { value: new Vector4(0.06, 0.08, 0.1, 0) } },
        });
    }

    /** How far away the camera sees the whole box. @param away where it is, of length 1. */
    #distanceToSeeAll(away) {
        const right = new Vector3().crossVectors(this.#camera.up, away).normalize();
        const above = new Vector3().crossVectors(away, right);
        const slope = Math.tan((this.#camera.fov * Math.PI) / 360);
        let distance = 0.1;
        for (let corner = 0; corner < 8; ++corner) {
            const place = new Vector3(...this.#halves.map((half, k) => ((corner >> k) & 1 ? half : -half)));
            const aside = Math.max(Math.abs(place.dot(above)), Math.abs(place.dot(right)) / this.#camera.aspect);
            distance = Math.max(distance, place.dot(away) + aside / slope);
        }
        return distance;
    }

    /** Puts the camera where it sees all. */
    reset() {
        const up = [0, 0, 0];
        up[this.#up] = 1;
        this.#camera.up.set(...up);
        const away = new Vector3();
        away.setComponent((this.#up + 1) % 3, 0.62);
        away.setComponent((this.#up + 2) % 3, -1);
        away.setComponent(this.#up, 0.62).normalize();
        this.#camera.position.copy(away).setLength(1.06 * this.#distanceToSeeAll(away));
        this.#controls.target.set(0, 0, 0);
        this.#controls.update();
        this.#untouched = true;
        this.draw();
    }

    #resize(canvas) {
        const { clientWidth: width, clientHeight: height } = canvas;
        if (width === 0 || height === 0)
            return;
        this.#renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.#renderer.setSize(width, height, false);
        this.#camera.aspect = width / height;
        this.#camera.updateProjectionMatrix();
        if (this.#untouched)
            this.reset();
        this.draw();
    }

    /** @param triangles see withFlatLabels. */
    setTriangles(triangles) {
        this.#doubled = triangles.doubled;
        this.#geometry.setIndex(new BufferAttribute(triangles.index, 1));
        const n = triangles.labels.length;
        this.#geometry.setAttribute("label", new BufferAttribute(new Uint8Array(4 * n).fill(200), 4, true));
        this.#geometry.setAttribute("value", new BufferAttribute(new Uint16Array(2 * n), 2, true));
        this.#geometry.deleteAttribute("position");
    }

    /** @param index two vertices for each edge. */
    setEdges(index) {
        this.#edgeGeometry.setIndex(new BufferAttribute(index, 1));
        this.#edgeGeometry.setAttribute("position", this.#geometry.getAttribute("position"));
    }

    get hasEdges() {
        return this.#edgeGeometry.index !== null;
    }

    showEdges(visible) {
        this.#edges.visible = visible && this.hasEdges;
        this.draw();
    }

    /** An array of the mesh's vertices with the doubled ones after them. */
    #withDoubled(numbers, stride) {
        const n = numbers.length;
        const result = new Uint16Array(n + stride * this.#doubled.length);
        result.set(numbers);
        this.#doubled.forEach((v, k) => {
            for (let c = 0; c < stride; ++c)
                result[n + stride * k + c] = numbers[stride * v + c];
        });
        return result;
    }

    #replace(name, numbers, stride) {
        const all = this.#withDoubled(numbers, stride);
        const old = this.#geometry.getAttribute(name);
        if (old && old.array.length === all.length) {
            old.array.set(all);
            old.needsUpdate = true;
        } else {
            this.#geometry.setAttribute(name, new BufferAttribute(all, stride, true));
        }
    }

    /** @param numbers four of 16 bits for each vertex. @param box its lower and upper corner. */
    setPositions(numbers, box) {
        this.#replace("position", numbers, 4);
        this.#edgeGeometry.setAttribute("position", this.#geometry.getAttribute("position"));
        const { lower, extent } = this.#surface.material.uniforms;
        lower.value.set(...box.lower.map((x, k) => (x - this.#centre[k]) / this.#radius));
        extent.value.set(...box.upper.map((x, k) => (x - box.lower[k]) / this.#radius));
    }

    #setMode(mode, lines = 0) {
        const { uniforms } = this.#surface.material;
        uniforms.mode.value = mode;
        uniforms.lines.value = lines;
    }

    colourPlainly() {
        this.#setMode(0);
    }

    /** @param colours for each vertex, red, green and blue. */
    colourByLabel(colours) {
        const attribute = this.#geometry.getAttribute("label");
        for (let v = 0; v < attribute.count; ++v)
            attribute.array.set(colours(v), 4 * v);
        attribute.needsUpdate = true;
        this.#setMode(1);
    }

    /** @param numbers two of 16 bits for each vertex. @param largest that of the values, in ends of the ramp. */
    colourByValue(numbers, largest, ramp) {
        this.#replace("value", numbers, 2);
        const { uniforms } = this.#surface.material;
        uniforms.largest.value = largest;
        uniforms.ramp.value.image.data.set(ramp);
        uniforms.ramp.value.needsUpdate = true;
        this.#setMode(2);
    }

    /** As by values from 0 to 1, with sixteen dark lines of equal value. */
    colourByTexture(numbers, ramp) {
        this.colourByValue(numbers, 1, ramp);
        this.#setMode(2, 16);
    }

    /** Edges that are close together on the screen are faint, or they would hide all else. */
    #inkEdges() {
        const { height } = this.#renderer.domElement;
        const distance = this.#camera.position.distanceTo(this.#controls.target);
        const seen = (this.#meanEdge * height) / (2 * Math.tan((this.#camera.fov * Math.PI) / 360) * distance);
        this.#edges.material.uniforms.ink.value.w = 0.5 * Math.min(Math.max(seen / 10, 0.02), 1);
    }

    /** Draws in the next frame, once. */
    draw() {
        if (this.#drawing)
            return;
        this.#drawing = true;
        requestAnimationFrame(() => {
            this.#drawing = false;
            if (!this.#geometry.getAttribute("position"))
                return;
            this.#inkEdges();
            this.#renderer.render(this.#scene, this.#camera);
        });
    }
}
