// Puts the page together: what is chosen, unpacked, is drawn.

import { fieldOf, offer, rangeOf, reflect, showLegend } from "./controls.js";
import { facts, remembering, unpacked16, unpacked32, unpackedBytes } from "./data.js";
import { drawableTriangles, edgesOf, heightsOf, inOrder, labelsOfTriangles } from "./faces.js";
import { element, showFacts, showOutcome, summary } from "./facts.js";
import { creases, sizesOf, vertexNormals } from "./normals.js";
import * as own from "./own_colours.js";
import { colourOfClass, colourOfLabel, ramp } from "./palette.js";
import { Player } from "./player.js";
import { Plots } from "./plots.js";
import { listenToKeys } from "./shortcuts.js";
import { guessUp } from "./upright.js";
import { View } from "./view.js";
import { Wipe } from "./wipe.js";
import { explain, showMeanings } from "./words.js";

const byId = (id) => document.getElementById(id);

const positionsIn = remembering(6, (block) => unpacked16(block, 3, 4));
const valuesIn = remembering(6, (block) => unpacked16(block, 1, 2));
const bytesIn = remembering(2, unpackedBytes);
const cornersOnce = remembering(1, (block) => unpacked32(block, 3));

/** The heights (z) of the input, from its lowest to its highest vertex. */
const texture = remembering(1, async (block) => heightsOf(await positionsIn(block)));

/** The last state at first. */
const chosen = { flow: 0, state: Infinity, surface: "after", colour: "plain", edges: false, flat: false, wipe: false, range: "step" };
const flow = () => facts.flows[chosen.flow];
const state = () => flow().states[chosen.state];

let view = null;
let triangles = null;
let turn = 0;

/** The states' surfaces that are shown: on the right that which is chosen, on the left of a wipe the input. */
function surfaces() {
    const input = flow().states[0].surface;
    if (chosen.surface === "before")
        return { right: input };
    const right = (chosen.surface === "undecomposed" && state().undecomposed) || state().surface;
    return chosen.wipe ? { right, left: input } : { right };
}

/** What an asynchronous function makes of each entry. */
const ofEach = async (entries, make) => Object.fromEntries(await Promise.all(Object.entries(entries).map(async ([key, value]) => [key, await make(value, key)])));

async function colourByField() {
    const { number, is_colour: isColour, least, most } = fieldOf(flow(), chosen);
    const of = (side) => flow().states[side === "left" || chosen.surface === "before" ? 0 : chosen.state].fields[number];
    if (isColour) {
        const colours = await ofEach(surfaces(), (_, side) => bytesIn(of(side).block));
        return () => view.colourByVertex(colours);
    }
    const { begin, end, step } = rangeOf(flow(), chosen);
    const length = end - begin || 1;
    const values = await ofEach(surfaces(), async (_, side) => ({ numbers: await valuesIn(of(side).block), largest: (of(side).largest * (most - least)) / length }));
    const lines = step > 0 ? { lines: length / step, first: -begin / length, fine: true } : {};
    return () => view.colourByValue(values, ramp("field"), (begin - least) / length, lines);
}

async function colour() {
    if (chosen.colour === "plain")
        return () => view.colourPlainly();
    if (chosen.colour === "sub-mesh")
        return () => view.colourByLabel((v) => colourOfLabel(triangles.labels[v]));
    if (chosen.colour === "class")
        return () => view.colourByLabel((v) => colourOfClass(flow().report.subdomain_colours[triangles.labels[v]] ?? 0));
    if (chosen.colour === "file")
        return () => view.colourByMaterial();
    if (chosen.colour === "vertices") {
        const colours = await ofEach(surfaces(), () => ownColours());
        return () => view.colourByVertex(colours);
    }
    if (chosen.colour === "texture") {
        const numbers = await texture(facts.flows[0].states[0].surface.positions.block);
        const values = await ofEach(surfaces(), async () => ({ numbers, largest: 1 }));
        return () => view.colourByTexture(values, ramp("texture"));
    }
    if (fieldOf(flow(), chosen))
        return colourByField();
    const { end } = rangeOf(flow(), chosen);
    const values = await ofEach(surfaces(), async ({ curvature }, side) => {
        const field = chosen.colour === "curvature" ? curvature : side === "left" ? flow().states[0].distance : state().distance;
        return { numbers: await valuesIn(field.block), largest: end > 0 ? (field.largest ?? 0) / end : 0 };
    });
    return () => view.colourByValue(values, ramp(chosen.colour));
}

/** Where the surface must not be shaded smoothly: at the creases of the input, or if it is too rough, of the last state. */
async function creasesOfAll(corners) {
    const { states } = facts.flows[0];
    const of = async ({ surface: { positions } }) => creases(corners, await positionsIn(positions.block), sizesOf(positions), facts.mesh.vertices);
    const input = await of(states[0]);
    return input.share > 0.25 && states.length > 1 ? of(states.at(-1)) : input;
}
const creasesOnce = remembering(1, async (block) => (await creasesOfAll(await cornersOnce(block))).groups);

const ownColours = remembering(1, own.vertexColours);
const layoutOnce = remembering(1, (perFace) => (own.hasMaterials ? own.layout(perFace, facts.mesh.triangles) : null));

const normalsOf = remembering(4, async (positions) =>
    vertexNormals(triangles.smooth.corners, triangles.smooth.vertexOf, await positionsIn(positions.block), sizesOf(positions)),
);

const lengthOf = ({ lower, upper }) => Math.max(...upper.map((x, k) => x - lower[k]));

/** Whether nothing of a surface is to be seen where the input fills the view. */
const isPoint = (box) => lengthOf(box) < 1e-4 * lengthOf(facts.flows[0].states[0].surface.positions);

/** Makes the edges when they are asked for first. */
async function edges() {
    if (!chosen.edges || view.hasEdges)
        return;
    const [corners, bits] = await Promise.all([cornersOnce(facts.mesh.corners), unpackedBytes(facts.mesh.edges)]);
    view.setEdges(edgesOf(corners, bits));
}

/** Shows what is chosen; the last choice counts. */
async function show() {
    const mine = ++turn;
    byId("stage").setAttribute("aria-busy", "true");
    reflect(flow(), chosen);
    showLegend(flow(), chosen, rangeOf(flow(), chosen));
    plots.redraw();
    if (view === null) {
        byId("stage").setAttribute("aria-busy", "false");
        return;
    }
    const [places, paint] = await Promise.all([
        ofEach(surfaces(), async ({ positions }) => ({
            box: positions,
            points: await positionsIn(positions.block),
            normals: chosen.flat ? null : await normalsOf(positions),
        })),
        colour(),
        edges(),
    ]);
    if (mine !== turn)
        return;
    for (const [side, { box, points, normals }] of Object.entries(places))
        view.setPositions(side, points, normals, box);
    paint();
    view.wipeAt(places.left === undefined ? null : wipe.part);
    view.showEdges(chosen.edges);
    byId("message").textContent = facts.mesh.faces === 0 ? "The mesh has no faces to show." : isPoint(places.right.box) ? "The surface has shrunk to a point." : "";
    requestAnimationFrame(() => requestAnimationFrame(() => mine === turn && byId("stage").setAttribute("aria-busy", "false")));
}

/** Shows one of the states. */
function chooseState(index) {
    chosen.state = Math.min(Math.max(index, 0), flow().states.length - 1);
    if (chosen.surface === "before")
        chosen.surface = "after";
    return show();
}

/** Shows the state nearest to a step. */
function chooseStep(step) {
    player.stop();
    const far = flow().states.map((other) => Math.abs(other.step - step));
    chooseState(far.indexOf(Math.min(...far)));
}

const player = new Player(byId("play"), { state: () => chosen.state, states: () => flow().states.length, choose: chooseState });
const wipe = new Wipe(byId("divider"), (part) => view?.wipeAt(part));
const plots = new Plots({ step: () => state().step, choose: chooseStep });

const perFaceOnce = remembering(1, (block) => unpacked32(block, 1));

/** The triangles as they are drawn, in the order of the file's materials if it has any. */
async function arranged(corners, groups, labels, perFace) {
    const layout = await layoutOnce(perFace);
    if (layout === null)
        return { ...drawableTriangles(corners, groups, labels, facts.mesh.vertices), places: null };
    const { order, placeOfCorner, places } = layout;
    const made = drawableTriangles(
        inOrder(corners, order, 3),
        inOrder(groups, order, 3),
        inOrder(labels, order, 1),
        facts.mesh.vertices,
        placeOfCorner && inOrder(placeOfCorner, order, 3),
    );
    return { ...made, places, groups: layout.groups };
}

async function chooseFlow(index) {
    chosen.flow = index;
    offer(flow(), chosen);
    byId("summary").textContent = summary(facts.mesh, flow().report);
    showOutcome(byId("outcome"), flow().report);
    explain(byId("outcome"));
    showFacts(byId("facts-table"), facts.mesh, flow());
    explain(byId("summary"));
    explain(byId("facts-table"));
    plots.show(flow().report);
    if (view !== null) {
        const [corners, groups, perFace, ofFaces] = await Promise.all([
            cornersOnce(facts.mesh.corners),
            creasesOnce(facts.mesh.corners),
            perFaceOnce(facts.mesh.per_face),
            unpacked32(flow().labels, 1),
        ]);
        if (index !== chosen.flow)
            return;
        triangles = await arranged(corners, groups, labelsOfTriangles(ofFaces, perFace, facts.mesh.triangles), perFace);
        if (index !== chosen.flow)
            return;
        normalsOf.clear();
        view.setTriangles(triangles, triangles.places);
    }
    await show();
}

/** Saves what is seen, under the name of the mesh. */
async function savePicture() {
    const style = getComputedStyle(document.documentElement);
    const href = URL.createObjectURL(await view.picture(style.getPropertyValue("--panel").trim(), style.getPropertyValue("--accent").trim()));
    const name = facts.title.replace(/\.(obj|off|ply|stl)(\.gz)?$/i, "").replace(/[^\p{L}\p{N}._-]+/gu, "_");
    element("a", { href, download: `${name}.png` }).click();
    setTimeout(() => URL.revokeObjectURL(href), 60000);
}

function listen() {
    showMeanings(byId("tip"));
    const on = (id, event, act) =>
        byId(id).addEventListener(event, ({ target }) => {
            act(target);
            show();
        });
    on("surfaces", "change", ({ value }) => {
        chosen.surface = value;
        chosen.wipe &&= value !== "before";
    });
    on("wipe", "change", ({ checked }) => {
        chosen.wipe = checked;
        if (checked && chosen.surface === "before")
            chosen.surface = "after";
    });
    on("colour", "change", ({ value }) => (chosen.colour = value));
    on("edges", "change", ({ checked }) => (chosen.edges = checked));
    on("flat", "change", ({ checked }) => (chosen.flat = checked));
    on("range", "change", ({ value }) => (chosen.range = value));
    byId("up").addEventListener("change", ({ target }) => view?.setUp(ups[target.value]));
    byId("reset").addEventListener("click", () => view?.reset());
    byId("picture").addEventListener("click", () => view && savePicture());
    byId("step").addEventListener("input", ({ target }) => chooseStep(flow().states[target.value].step));
    byId("flow").addEventListener("change", ({ target }) => chooseFlow(Number(target.value)));
    listenToKeys(byId("help"), (by) => chooseStep(flow().states[Math.min(Math.max(chosen.state + by, 0), flow().states.length - 1)].step));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => plots.show(flow().report));
}

const ups = Object.fromEntries([0, 1, 2].flatMap((axis) => [1, -1].map((sign) => [`${sign > 0 ? "+" : "−"}${"XYZ"[axis]}`, { axis, sign }])));

/** Stands the surface upright, as far as that can be guessed. */
async function standUpright() {
    const { states, report } = facts.flows[0];
    const { positions } = states[0].surface;
    const [points, corners] = await Promise.all([positionsIn(positions.block), cornersOnce(facts.mesh.corners)]);
    const { axis, sign } = guessUp(points, positions.upper.map((x, k) => x - positions.lower[k]), corners, report.input);
    const guess = Object.keys(ups).find((name) => ups[name].axis === axis && ups[name].sign === sign);
    byId("up").replaceChildren(...Object.keys(ups).map((value) => element("option", { value }, value)));
    byId("up").value = guess;
    const last = states.at(-1).surface.positions;
    view.fitTo([{ points, box: positions }, { points: await positionsIn(last.block), box: last }]);
    view.setUp(ups[guess]);
}

/** A mesh that has a texture or colours is shown in them at first. A page with several flows is about what a cut does, and what becomes of the texture. */
function chooseFirst() {
    chosen.range = facts.flows[0].fields ? "all" : "step";
    if (facts.flows[0].fields) {
        chosen.colour = "field-0";
        return 0;
    }
    if (facts.flows.length < 2) {
        chosen.colour = own.hasMaterials ? "file" : own.hasVertexColours ? "vertices" : "plain";
        return 0;
    }
    chosen.colour = "texture";
    return Math.max(facts.flows.findIndex(({ report }) => report.subdomains > 1), 0);
}

async function start() {
    byId("title").textContent = facts.title;
    byId("flow").replaceChildren(...facts.flows.map(({ name }, value) => element("option", { value }, name)));
    byId("flow-choice").hidden = facts.flows.length < 2;
    try {
        view = new View(byId("canvas"), facts.flows[0].states[0].surface.positions, facts.mesh.mean_edge);
    } catch {
        byId("message").textContent = "The surface takes WebGL 2, which this browser does not offer here.";
    }
    listen();
    if (view !== null) {
        await standUpright();
        if (own.hasMaterials)
            view.setMaterials(await own.materials(), facts.mesh.colours.places);
    }
    const first = chooseFirst();
    byId("flow").value = first;
    await chooseFlow(first);
}

start().catch((error) => {
    byId("message").textContent = `This page cannot be shown here: ${error.message}`;
    throw error;
});
