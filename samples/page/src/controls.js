// What the user can choose, and the legend that says what is seen.

import { digits, digitsOfEach, element, stepsOf } from "./facts.js";
import { hasImages, hasMaterials, hasVertexColours } from "./own_colours.js";
import { colourOfClass, colourOfLabel, css, cssRamp } from "./palette.js";
import { explain } from "./words.js";

const byId = (id) => document.getElementById(id);

/** What the colours can mean for a flow: words, and for ramps the unit. */
export function meanings(flow) {
    const list = (flow.fields ?? []).map(({ name }, number) => [`field-${number}`, { name }]);
    list.push(["plain", { name: "Plain" }]);
    if (hasMaterials)
        list.push(["file", { name: hasImages ? "Texture of the file" : "Materials of the file" }]);
    if (hasVertexColours && !flow.fields?.[0].is_colour)
        list.push(["vertices", { name: "Colours of the file" }]);
    if (flow.report.subdomains > 1)
        list.push(["sub-mesh", { name: "Sub-mesh" }]);
    if (flow.report.colours > 1)
        list.push(["class", { name: "Colour class" }]);
    if (flow.fields)
        return new Map(list);
    list.push(
        flow.has_undecomposed
            ? ["distance", { name: "Distance to the undecomposed flow", unit: "mean edge lengths" }]
            : ["distance", { name: "Displacement from the input", unit: "mean edge lengths of the input" }],
        ["texture", { name: "Texture of heights" }],
        ["curvature", { name: "Mean curvature ‖ΔV‖ = |κ₁ + κ₂|", unit: "1/length" }],
    );
    return new Map(list);
}

/** The field whose colours are chosen, with its number; undefined if they mean something else. */
export const fieldOf = ({ fields = [] }, { colour }) => fields.map((field, number) => ({ ...field, number })).find(({ number }) => colour === `field-${number}`);

/** The length, 1, 2 or 5 times a power of ten, of which a range has ten to twenty-five. */
function lineStep(length) {
    const power = 10 ** Math.floor(Math.log10(length / 10));
    return [5, 2, 1].map((digit) => digit * power).find((step) => length / step >= 10);
}

/** Where the colours of a field begin and end, the same before and after, and the step of its lines, if it has any. */
function rangeOfField(flow, { least, most, percentile_1: low, percentile_99: high }, chosen) {
    const [begin, end] = chosen.range === "middle" && high > low ? [low, high] : [least, most];
    return { begin, end, step: flow.are_distances && end > begin ? lineStep(end - begin) : 0 };
}

/**
 * Where the colours of a ramp end, and the largest value: over all steps, or over the one that is shown, the same for
 * the decomposed and the undecomposed flow.
 */
export function rangeOf(flow, chosen) {
    const field = fieldOf(flow, chosen);
    if (field)
        return rangeOfField(flow, field, chosen);
    const shown = flow.states[chosen.colour === "curvature" && chosen.surface === "before" ? 0 : chosen.state];
    const states = chosen.range === "all" ? flow.states : [shown];
    const values = states.flatMap((state) =>
        chosen.colour === "distance" ? [state.distance] : [state.surface, state.undecomposed].filter(Boolean).map((surface) => surface.curvature),
    );
    const largest = Math.max(...values.map((value) => value.largest ?? 0));
    const percentile = Math.max(...values.map((value) => value.percentile_99 ?? 0));
    return { largest, end: chosen.range === "largest" || percentile === 0 ? largest : percentile };
}

const ranges = {
    ofFlows: { step: "99 % of this step", all: "99 % of all steps", largest: "largest of this step" },
    ofFields: { all: "all values", middle: "98 % of the values" },
};

/** Fills the controls for a flow; choices that it has, too, stay. */
export function offer(flow, chosen) {
    const known = meanings(flow);
    byId("colour").replaceChildren(...[...known].map(([value, { name }]) => element("option", { value }, name)));
    chosen.colour = known.has(chosen.colour) ? chosen.colour : "plain";
    byId("colour").value = chosen.colour;
    const entries = flow.fields ? ranges.ofFields : ranges.ofFlows;
    byId("range").replaceChildren(...Object.entries(entries).map(([value, name]) => element("option", { value }, name)));
    byId("range-word").textContent = flow.fields ? "Scale" : "up to";
    const undecomposed = document.querySelector('[value="undecomposed"]');
    undecomposed.disabled = !flow.has_undecomposed;
    undecomposed.parentElement.hidden = !flow.has_undecomposed;
    if (chosen.surface === "undecomposed" && !flow.has_undecomposed)
        chosen.surface = "after";
    const isAlone = flow.states.length === 1;
    byId("surfaces").hidden = byId("surfaces").disabled = isAlone;
    byId("wipe").parentElement.hidden = byId("wipe").disabled = isAlone;
    byId("step").closest(".steps").hidden = isAlone;
    byId("step").max = flow.states.length - 1;
    chosen.state = Math.min(chosen.state, flow.states.length - 1);
}

const hasScale = (field) => field !== undefined && field.has_data && !field.is_colour;

/** Shows what is chosen. */
export function reflect(flow, chosen) {
    document.querySelector(`[value="${chosen.surface}"]`).checked = true;
    byId("step").value = chosen.state;
    const { step } = flow.states[chosen.state];
    const steps = stepsOf(flow.report).length || flow.report.steps;
    byId("step-name").textContent = step === 0 ? "Input" : `Step ${step} of ${steps}`;
    byId("step").setAttribute("aria-valuetext", byId("step-name").textContent);
    byId("range-choice").hidden = !["distance", "curvature"].includes(chosen.colour) && !hasScale(fieldOf(flow, chosen));
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

/** What the colours of a field mean. @param range see rangeOf. */
function fieldLegend(flow, { is_colour: isColour, has_data: hasData, has_gaps: hasGaps, least, most }, { begin, end, step }) {
    if (!hasData)
        return [swatches([[[128, 128, 128], "no data"]])];
    const list = [];
    if (!isColour) {
        const strip = element("span", { className: "ramp" });
        strip.style.background = cssRamp("field");
        const ends = digitsOfEach([begin, 0.5 * begin + 0.5 * end, end]);
        const marks = [least < begin ? "≤ " : "", "", most > end ? "≥ " : ""];
        list.push(strip, element("div", { className: "ends" }, ...ends.map((text, k) => element("span", {}, marks[k] + text))));
    }
    const words = [
        ...(!isColour && flow.states.length > 1 ? ["the same scale before and after"] : []),
        ...(step > 0 ? [`a line every ${digits(step)}`] : []),
        ...(hasGaps ? ["grey: no data"] : []),
    ];
    return words.length > 0 ? [...list, element("div", { className: "quiet" }, words.join("; "))] : list;
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
    const field = fieldOf(flow, chosen);
    if (field) {
        parts.push(...fieldLegend(flow, field, range));
    } else if (chosen.colour === "sub-mesh") {
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
