// What the user can choose, and the legend that says what is seen.

import { digits, element } from "./facts.js";
import { hasImages, hasMaterials, hasVertexColours } from "./own_colours.js";
import { colourOfClass, colourOfLabel, css, cssRamp } from "./palette.js";
import { explain } from "./words.js";

const byId = (id) => document.getElementById(id);

/** What the colours can mean for a flow: words, and for ramps the unit. */
export function meanings(flow) {
    const list = [["plain", { name: "Plain" }]];
    if (hasMaterials)
        list.push(["file", { name: hasImages ? "Texture of the file" : "Materials of the file" }]);
    if (hasVertexColours)
        list.push(["vertices", { name: "Colours of the file" }]);
    if (flow.report.subdomains > 1)
        list.push(["sub-mesh", { name: "Sub-mesh" }]);
    if (flow.report.colours > 1)
        list.push(["class", { name: "Colour class" }]);
    list.push(
        flow.has_undecomposed
            ? ["distance", { name: "Distance to the undecomposed flow", unit: "mean edge lengths" }]
            : ["distance", { name: "Displacement from the input", unit: "mean edge lengths of the input" }],
        ["texture", { name: "Texture of heights" }],
        ["curvature", { name: "Mean curvature ‖ΔV‖ = |κ₁ + κ₂|", unit: "1/length" }],
    );
    return new Map(list);
}

/**
 * Where the colours of a ramp end, and the largest value: over all steps, or over the one that is shown, the same for
 * the decomposed and the undecomposed flow.
 */
export function rangeOf(flow, chosen) {
    const shown = flow.states[chosen.colour === "curvature" && chosen.surface === "before" ? 0 : chosen.state];
    const states = chosen.range === "all" ? flow.states : [shown];
    const values = states.flatMap((state) =>
        chosen.colour === "distance" ? [state.distance] : [state.surface, state.undecomposed].filter(Boolean).map((surface) => surface.curvature),
    );
    const largest = Math.max(...values.map((value) => value.largest ?? 0));
    const percentile = Math.max(...values.map((value) => value.percentile_99 ?? 0));
    return { largest, end: chosen.range === "largest" || percentile === 0 ? largest : percentile };
}

/** Fills the controls for a flow; choices that it has, too, stay. */
export function offer(flow, chosen) {
    const known = meanings(flow);
    byId("colour").replaceChildren(...[...known].map(([value, { name }]) => element("option", { value }, name)));
    chosen.colour = known.has(chosen.colour) ? chosen.colour : "plain";
    byId("colour").value = chosen.colour;
    const undecomposed = document.querySelector('[value="undecomposed"]');
    undecomposed.disabled = !flow.has_undecomposed;
    undecomposed.parentElement.hidden = !flow.has_undecomposed;
    if (chosen.surface === "undecomposed" && !flow.has_undecomposed)
        chosen.surface = "after";
    byId("step").max = flow.states.length - 1;
    chosen.state = Math.min(chosen.state, flow.states.length - 1);
}

/** Shows what is chosen. */
export function reflect(flow, chosen) {
    document.querySelector(`[value="${chosen.surface}"]`).checked = true;
    byId("step").value = chosen.state;
    const { step } = flow.states[chosen.state];
    const steps = flow.report.steps.length;
    byId("step-name").textContent = step === 0 ? "Input" : `Step ${step} of ${steps}`;
    byId("step").setAttribute("aria-valuetext", byId("step-name").textContent);
    byId("range-choice").hidden = !["distance", "curvature"].includes(chosen.colour);
    byId("range").value = chosen.range;
    byId("edges").checked = chosen.edges;
    byId("flat").checked = chosen.flat;
    byId("wipe").checked = chosen.wipe;
    byId("divider").hidden = !chosen.wipe;
    byId("right-side").textContent = chosen.surface === "undecomposed" ? "Undecomposed" : step === 0 ? "Input" : `After step ${step}`;
}

function swatches(entries) {
    const list = element("ul");
    for (const [colour, text] of entries) {
        const square = element("span", { className: "swatch" });
        square.style.background = css(colour);
        list.append(element("li", {}, square, text));
    }
    return list;
}

function rampLegend(name, { unit }, { largest, end }) {
    const strip = element("span", { className: "ramp" });
    strip.style.background = cssRamp(name);
    const beyond = largest > end;
    const ends = [0, 0.5, 1].map((part) => element("span", {}, `${part === 1 && beyond ? "≥ " : ""}${digits(part * end)}`));
    const largestText = beyond ? `; the largest is ${digits(largest)}` : "";
    return [strip, element("div", { className: "ends" }, ...ends), element("div", { className: "quiet" }, `in ${unit}${largestText}`)];
}

/** @param range see rangeOf. */
export function showLegend(flow, chosen, range) {
    const legend = byId("legend");
    const meaning = meanings(flow).get(chosen.colour);
    const { report } = flow;
    if (["plain", "file", "vertices"].includes(chosen.colour)) {
        legend.replaceChildren();
        return;
    }
    const parts = [element("div", {}, meaning.name)];
    if (chosen.colour === "sub-mesh") {
        const few = Math.min(report.subdomains, 12);
        parts.push(swatches(Array.from({ length: few }, (_, k) => [colourOfLabel(k), String(k)])));
        if (few < report.subdomains)
            parts.push(element("div", { className: "quiet" }, `and so on: 0 to ${report.subdomains - 1}`));
    } else if (chosen.colour === "class") {
        const count = (c) => report.subdomain_colours.filter((other) => other === c).length;
        const name = (c) => `${c}${c === 0 ? " (first in even steps)" : ""}: ${count(c)}`;
        parts.push(swatches(Array.from({ length: Math.min(report.colours, 12) }, (_, c) => [colourOfClass(c), name(c)])));
        parts.push(element("div", { className: "quiet" }, "number of sub-meshes in each"));
    } else if (chosen.colour === "texture") {
        parts.push(element("div", { className: "quiet" }, "z in the input, from blue (lowest) to red; its lines go with the vertices"));
    } else {
        parts.push(...rampLegend(chosen.colour, meaning, range));
    }
    legend.replaceChildren(...parts);
    explain(legend);
}
