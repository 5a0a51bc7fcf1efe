// The view in three dimensions. It is drawn when something changes, and only then.

import {
    BufferAttribute, DataTexture, LinearFilter, LinearMipmapLinearFilter, PerspectiveCamera, RepeatWrapping, Scene, Texture,
    Vector3, Vector4, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { inkOfEdges, Layer, sharedAttributes } from "./layer.js";

export class View {
    #renderer;
    #scene = new Scene();
    #camera = new PerspectiveCamera(32, 1, 0.02, 60);
    #controls;
    #shared;
    #attributes = null;
    #layers;
    #wipe = null;
    #edges = null;
    #showsEdges = false;
    #centre;
    #radius;
    #extremes;
    #meanEdge;
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
        this.#extremes = Array.from({ length: 8 }, (_, corner) => new Vector3(...halves.map((half, k) => (((corner >> k) & 1 ? 1 : -1) * half) / this.#radius)));
        this.#meanEdge = meanEdge / this.#radius;
        const ramp = new DataTexture(new Uint8Array(4 * 256), 256, 1);
        this.#shared = {
            mode: { value: 0 },
            lines: { value: 0 },
            firstLine: { value: 0 },
            fine: { value: false },
            begin: { value: 0 },
            smoothly: { value: true },
            ramp: { value: ramp },
            image: { value: ramp },
            tint: { value: new Vector3(1, 1, 1) },
            uvBox: { value: new Vector4(0, 0, 1, 1) },
            plain: { value: new Vector3(0.86, 0.87, 0.885) },
            ink: inkOfEdges(),
        };
        this.#layers = { right: new Layer(this.#scene, this.#shared), left: new Layer(this.#scene, this.#shared) };
        this.#controls = new OrbitControls(this.#camera, canvas);
        // A finger that goes up or down scrolls the page; sideways it turns the surface, and two fingers do the rest.
        canvas.style.touchAction = "pan-y";
        this.#controls.cursorStyle = "grab";
        this.#controls.addEventListener("change", () => this.draw());
        this.#controls.addEventListener("start", () => (this.#untouched = false));
        this.#controls.minDistance = 0.05;
        this.#controls.maxDistance = 30;
        this.#controls.listenToKeyEvents(canvas);
        new ResizeObserver(() => this.#resize(canvas)).observe(canvas);
        this.reset();
        this.#resize(canvas);
    }

    /** How far away the camera sees all. @param away where it is, of length 1. */
    #distanceToSeeAll(away) {
        const right = new Vector3().crossVectors(this.#camera.up, away).normalize();
        const above = new Vector3().crossVectors(away, right);
        const slope = Math.tan((this.#camera.fov * Math.PI) / 360);
        return this.#extremes.reduce((distance, extreme) => {
            const place = extreme.clone().applyQuaternion(this.#scene.quaternion);
            const aside = Math.max(Math.abs(place.dot(above)), Math.abs(place.dot(right)) / this.#camera.aspect);
            return Math.max(distance, place.dot(away) + aside / slope);
        }, 0.1);
    }

    /** Puts the camera where it sees all, from the front, a little from the side and from above. */
    reset() {
        const away = new Vector3(0.62, 0.5, 1).normalize();
        this.#camera.position.copy(away).setLength(1.1 * this.#distanceToSeeAll(away));
        this.#controls.target.set(0, 0, 0);
        this.#controls.update();
        this.#untouched = true;
        this.draw();
    }

    /** Turns the surface, as the camera has y upwards. @param up axis from 0 to 2 and sign. */
    setUp({ axis, sign }) {
        this.#scene.quaternion.setFromUnitVectors(new Vector3().setComponent(axis, sign), this.#camera.up);
        this.reset();
    }

    /** Looks at what there is, not at its box. @param surfaces points, four numbers of 16 bits each, and the box of these. */
    fitTo(surfaces) {
        this.#extremes = surfaces.flatMap(({ points, box: { lower, upper } }) => {
            const n = points.length / 4;
            const stride = Math.ceil(n / 4000) || 1;
            return Array.from({ length: Math.ceil(n / stride) }, (_, k) =>
                new Vector3(...lower.map((low, c) => (low + ((upper[c] - low) * points[4 * k * stride + c]) / 65535 - this.#centre[c]) / this.#radius)),
            );
        });
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

    /**
     * Takes the materials of the file: of each its colour, from 0 to 255, and its image or null.
     * @param box of the places in images, or undefined.
     */
    setMaterials(materials, box) {
        if (box)
            this.#shared.uvBox.value.set(box.lower[0], box.lower[1], box.upper[0] - box.lower[0], box.upper[1] - box.lower[1]);
        const white = new DataTexture(new Uint8Array(4).fill(255), 1, 1);
        white.needsUpdate = true;
        const uniforms = materials.map(({ colour, image }) => {
            const texture = image === null ? white : new Texture(image);
            if (image !== null)
                Object.assign(texture, { wrapS: RepeatWrapping, wrapT: RepeatWrapping, minFilter: LinearMipmapLinearFilter, magFilter: LinearFilter, anisotropy: 8, needsUpdate: true });
            return { image: { value: texture }, tint: { value: new Vector3(...colour.map((part) => part / 255)) } };
        });
        for (const layer of Object.values(this.#layers))
            layer.setMaterials(uniforms);
    }

    /** @param triangles see drawableTriangles. @param places in images, four numbers of 16 bits each, or null. */
    setTriangles(triangles, places) {
        this.#attributes = sharedAttributes(triangles, places);
        for (const layer of Object.values(this.#layers))
            layer.setTriangles(triangles, this.#attributes);
    }

    /** @param index two vertices for each edge. */
    setEdges(index) {
        this.#edges = new BufferAttribute(index, 1);
    }

    get hasEdges() {
        return this.#edges !== null;
    }

    showEdges(visible) {
        this.#showsEdges = visible && this.hasEdges;
        if (this.#showsEdges)
            for (const layer of Object.values(this.#layers))
                layer.setEdges(this.#edges);
        this.draw();
    }

    /** @param side "right", or "left" of the wipe. For the others see Layer. */
    setPositions(side, numbers, normals, box) {
        this.#layers[side].setPositions(numbers, normals, box, this.#centre, this.#radius);
        this.#shared.smoothly.value = normals !== null;
    }

    /** @param part of the width at which the left layer ends and the right one begins; null: there is only the latter. */
    wipeAt(part) {
        this.#wipe = part;
        this.draw();
    }

    /** @param lines how many of equal value there are on the ramp. @param first where one is. @param fine on the screen, not in values. */
    #setMode(mode, { lines = 0, first = 0, fine = false } = {}) {
        this.#shared.mode.value = mode;
        this.#shared.lines.value = lines;
        this.#shared.firstLine.value = first;
        this.#shared.fine.value = fine;
    }

    colourPlainly() {
        this.#setMode(0);
    }

    /** @param colours for each vertex that is drawn, red, green and blue. */
    colourByLabel(colours) {
        const attribute = this.#attributes.label;
        for (let v = 0; v < attribute.count; ++v)
            attribute.array.set(colours(v), 4 * v);
        attribute.needsUpdate = true;
        this.#setMode(1);
    }

    /** @param colours for each side those of the vertices, see Layer. */
    colourByVertex(colours) {
        for (const [side, ofSide] of Object.entries(colours))
            this.#layers[side].setColours(ofSide);
        this.#setMode(4);
    }

    /** In the colours and images of the file's materials. */
    colourByMaterial() {
        this.#setMode(3);
    }

    /** @param values for each side numbers and the largest, see Layer. @param begin where the ramp begins, in ends of it from there. */
    colourByValue(values, ramp, begin = 0, lines = {}) {
        for (const [side, { numbers, largest }] of Object.entries(values))
            this.#layers[side].setValues(numbers, largest);
        const { image } = this.#shared.ramp.value;
        image.data.set(ramp);
        this.#shared.ramp.value.needsUpdate = true;
        this.#shared.begin.value = begin;
        this.#setMode(2, lines);
    }

    /** As by values from 0 to 1, with sixteen dark lines of equal value. */
    colourByTexture(values, ramp) {
        this.colourByValue(values, ramp, 0, { lines: 16 });
    }

    /** Edges that are close together on the screen are faint, or they would hide all else. */
    #inkEdges() {
        const { height } = this.#renderer.domElement;
        const distance = this.#camera.position.distanceTo(this.#controls.target);
        const seen = (this.#meanEdge * height) / (2 * Math.tan((this.#camera.fov * Math.PI) / 360) * distance);
        this.#shared.ink.value.w = 0.5 * Math.min(Math.max(seen / 10, 0.02), 1);
    }

    /** Draws one layer between two parts of the width. */
    #drawLayer(side, from, to) {
        for (const [name, layer] of Object.entries(this.#layers))
            layer.show(name === side, this.#showsEdges);
        const { clientWidth, clientHeight } = this.#renderer.domElement;
        this.#renderer.setScissor(from * clientWidth, 0, (to - from) * clientWidth, clientHeight);
        this.#renderer.render(this.#scene, this.#camera);
    }

    #drawNow() {
        this.#inkEdges();
        this.#renderer.setScissorTest(this.#wipe !== null);
        this.#drawLayer("right", this.#wipe ?? 0, 1);
        if (this.#wipe !== null)
            this.#drawLayer("left", 0, this.#wipe);
    }

    /** Draws in the next frame, once. */
    draw() {
        if (this.#drawing)
            return;
        this.#drawing = true;
        requestAnimationFrame(() => {
            this.#drawing = false;
            if (this.#attributes !== null)
                this.#drawNow();
        });
    }

    /** What is seen, before a ground of that colour, as a file. @param line at the wipe, a colour. */
    picture(ground, line) {
        const { domElement } = this.#renderer;
        const canvas = Object.assign(document.createElement("canvas"), { width: domElement.width, height: domElement.height });
        const context = canvas.getContext("2d");
        context.fillStyle = ground;
        context.fillRect(0, 0, canvas.width, canvas.height);
        this.#drawNow();
        context.drawImage(domElement, 0, 0);
        if (this.#wipe !== null) {
            context.fillStyle = line;
            context.fillRect(this.#wipe * canvas.width - 1, 0, 2, canvas.height);
        }
        return new Promise((done) => canvas.toBlob(done, "image/png"));
    }
}
