// Puts the page together: what is chosen, unpacked, is drawn.

import { offer, rangeOf, reflect, showLegend } from "./controls.js";
import { facts, remembering, unpacked16, unpacked32, unpackedBytes } from "./data.js";
import { edgesOf, heightsOf, labelsOfTriangles, withFlatLabels } from "./faces.js";
import { element, showFacts, summary } from "./facts.js";
import { colourOfClass, colourOfLabel, ramp } from "./palette.js";
import { Plots } from "./plots.js";
import { View } from "./view.js";
import { explain, showMeanings } from "./words.js";

const byId = (id) => document.getElementById(id);

const positionsIn = remembering(6, (block) => unpacked16(block, 3, 4));
const valuesIn = remembering(6, (block) => unpacked16(block, 1, 2));
const cornersOnce = remembering(1, (block) => unpacked32(block, 3));

/** The heights (z) of the input, from its lowest to its highest vertex. */
const texture = remembering(1, async (block) => heightsOf(await positionsIn(block)));

/** The last state at first. */
const chosen = { flow: 0, state: Infinity, surface: "after", colour: "plain", edges: false, range: "step" };
const flow = () => facts.flows[chosen.flow];
const state = () => flow().states[chosen.state];

let view = null;
let labels = null;
let turn = 0;

/** The state whose surface is shown. */
function surface() {
    if (chosen.surface === "before")
        return flow().states[0].surface;
    return (chosen.surface === "undecomposed" && state().undecomposed) || state().surface;
}

async function colour() {
    if (chosen.colour === "plain")
        return () => view.colourPlainly();
    if (chosen.colour === "sub-mesh")
        return () => view.colourByLabel((v) => colourOfLabel(labels[v]));
    if (chosen.colour === "class")
        return () => view.colourByLabel((v) => colourOfClass(flow().report.subdomain_colours[labels[v]] ?? 0));
    if (chosen.colour === "texture") {
        const heights = await texture(facts.flows[0].states[0].surface.positions.block);
        return () => view.colourByTexture(heights, ramp("texture"));
    }
    const field = chosen.colour === "curvature" ? surface().curvature : state().distance;
    const numbers = await valuesIn(field.block);
    const { end } = rangeOf(flow(), chosen);
    return () => view.colourByValue(numbers, end > 0 ? (field.largest ?? 0) / end : 0, ramp(chosen.colour));
}

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
    const { positions } = surface();
    const [places, paint] = await Promise.all([positionsIn(positions.block), colour(), edges()]);
    if (mine !== turn)
        return;
    view.setPositions(places, positions);
    paint();
    view.showEdges(chosen.edges);
    byId("message").textContent = facts.mesh.faces > 0 ? "" : "The mesh has no faces to show.";
    requestAnimationFrame(() => requestAnimationFrame(() => mine === turn && byId("stage").setAttribute("aria-busy", "false")));
}

/** Shows the state nearest to a step. */
function chooseStep(step) {
    const far = flow().states.map((other) => Math.abs(other.step - step));
    chosen.state = far.indexOf(Math.min(...far));
    if (chosen.surface === "before")
        chosen.surface = "after";
    show();
}

const plots = new Plots({ step: () => state().step, choose: chooseStep });

async function chooseFlow(index) {
    chosen.flow = index;
    offer(flow(), chosen);
    byId("summary").textContent = summary(facts.mesh, flow().report);
    showFacts(byId("facts-table"), flow());
    explain(byId("summary"));
    explain(byId("facts-table"));
    plots.show(flow().report);
    if (view !== null) {
        const [corners, perFace, ofFaces] = await Promise.all([
            cornersOnce(facts.mesh.corners),
            unpacked32(facts.mesh.per_face, 1),
            unpacked32(flow().labels, 1),
        ]);
        if (index !== chosen.flow)
            return;
        const triangles = withFlatLabels(corners, labelsOfTriangles(ofFaces, perFace, facts.mesh.triangles), facts.mesh.vertices);
        labels = triangles.labels;
        view.setTriangles(triangles);
    }
    await show();
}

function listen() {
    showMeanings(byId("tip"));
    const on = (id, event, act) =>
        byId(id).addEventListener(event, ({ target }) => {
            act(target);
            show();
        });
    on("surfaces", "change", ({ value }) => (chosen.surface = value));
    on("colour", "change", ({ value }) => (chosen.colour = value));
    on("edges", "change", ({ checked }) => (chosen.edges = checked));
    on("range", "change", ({ value }) => (chosen.range = value));
    byId("reset").addEventListener("click", () => view?.reset());
    byId("step").addEventListener("input", ({ target }) => chooseStep(flow().states[target.value].step));
    byId("flow").addEventListener("change", ({ target }) => chooseFlow(Number(target.value)));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => plots.show(flow().report));
}

/** A page with several flows is about what a cut does, and what becomes of the texture. */
function chooseFirst() {
    if (facts.flows.length < 2)
        return 0;
    chosen.colour = "texture";
    return Math.max(facts.flows.findIndex(({ report }) => report.subdomains > 1), 0);
}

async function start() {
    byId("title").textContent = facts.title;
    byId("flow").replaceChildren(...facts.flows.map(({ name }, value) => element("option", { value }, name)));
    byId("flow-choice").hidden = facts.flows.length < 2;
    try {
        view = new View(byId("canvas"), facts.flows[0].states[0].surface.positions, facts.flows[0].report.mean_edge);
    } catch {
        byId("message").textContent = "The surface takes WebGL 2, which this browser does not offer here.";
    }
    listen();
    const first = chooseFirst();
    byId("flow").value = first;
    await chooseFlow(first);
}

start().catch((error) => {
    byId("message").textContent = `This page cannot be shown here: ${error.message}`;
    throw error;
});
