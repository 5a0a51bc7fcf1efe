// Plots of what was measured step by step, and bars of where the time went.

import uPlot from "uplot";
import { digits, element, placesMeasured, seconds, stepsOf } from "./facts.js";
import { explain } from "./words.js";

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** An axis, or the grid of one, in the colours of the page. */
const axis = (more) => ({
    stroke: colour("--quiet"),
    grid: { stroke: colour("--line"), width: 1 },
    ticks: { stroke: colour("--line"), width: 1 },
    font: "11px system-ui, sans-serif",
    ...more,
});

/** Has the legend tell the numbers of a step; step 0 has none. */
const tellStep = (plot, step) => plot.setLegend({ idx: step > 0 ? step - 1 : null }, false);

/** Those of a logarithmic axis' ticks that are worth a line. */
const powersOfTen = (_, ticks) => ticks.map((tick) => (Number.isInteger(Math.round(1e6 * Math.log10(tick)) / 1e6) ? tick : null));

/** A line at the step that is shown. */
function drawStep(plot, step) {
    const x = Math.round(plot.valToPos(step, "x", true));
    const { ctx, bbox } = plot;
    if (x < bbox.left || x > bbox.left + bbox.width)
        return;
    ctx.save();
    ctx.strokeStyle = colour("--accent");
    ctx.globalAlpha = 0.55;
    ctx.lineWidth = 2 * devicePixelRatio;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
}

const height = 124;

/** Numbers that a logarithmic axis can show. */
const positive = (values) => values.map((value) => (value > 0 ? value : null));

/** Curves that have something to show, on axes of steps and of numbers. */
class Plot {
    #plot;
    #step;

    /**
     * @param curves name, numbers (one per step), place in the list of colours, dash.
     * @param places step() is the one shown; choose(step) shows another.
     */
    constructor(section, { title, unit, curves, logarithmic, format }, places) {
        const isOne = curves[0].values.length === 1;
        const drawable = (value) => Number.isFinite(value) && (isOne || !logarithmic || value > 0);
        const shown = curves.filter((curve) => curve.values.some(drawable));
        section.hidden = shown.length === 0;
        if (section.hidden)
            return;
        const holder = element("div", { className: isOne ? "numbers" : "plot" });
        section.replaceChildren(element("h2", {}, title, " ", element("small", {}, unit)), holder);
        if (isOne) {
            holder.append(...shown.map(({ name, values }) => element("dl", {}, element("dt", {}, name), element("dd", {}, format(values[0])))));
            explain(section);
            return;
        }
        const steps = shown[0].values.map((_, k) => k + 1);
        const options = {
            width: holder.clientWidth || 320,
            height,
            padding: [8, 8, 0, 0],
            legend: { markers: { width: 2 } },
            cursor: { y: false, points: { size: 6 }, drag: { x: false, y: false } },
            scales: {
                x: { time: false, range: [Math.min(1, steps.length) - 0.5, steps.length + 0.5] },
                y: logarithmic ? { distr: 3 } : { range: (_, low, high) => [0, high > 0 ? 1.1 * high : 1] },
            },
            axes: [
                axis({ size: 26, gap: 3, incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 5000, 20000], space: 30 }),
                axis({
                    size: 50,
                    gap: 3,
                    space: 22,
                    grid: { stroke: colour("--line"), width: 1, ...(logarithmic && { filter: powersOfTen }) },
                    ticks: { show: false },
                    values: (_, ticks) => ticks.map((tick) => (tick === null ? "" : format(tick))),
                }),
            ],
            series: [
                { label: "step", value: (_, step) => step ?? "–" },
                ...shown.map((curve) => ({
                    label: curve.name,
                    stroke: colour(`--series-${curve.colour}`),
                    width: 1.75,
                    dash: curve.dash,
                    spanGaps: false,
                    points: { show: steps.length < 40, size: 5, fill: colour(`--series-${curve.colour}`) },
                    value: (_, value) => format(value),
                })),
            ],
            hooks: {
                draw: [(plot) => drawStep(plot, places.step())],
                setCursor: [(plot) => plot.cursor.idx === null && tellStep(plot, places.step())],
            },
        };
        const data = [steps, ...shown.map(({ values }) => (logarithmic ? positive(values) : values))];
        this.#plot = new uPlot(options, data, holder);
        this.#step = places.step;
        tellStep(this.#plot, places.step());
        explain(section);
        this.#plot.over.addEventListener("click", () => {
            if (this.#plot.cursor.idx !== null)
                places.choose(steps[this.#plot.cursor.idx]);
        });
    }

    resize() {
        const width = this.#plot?.root.parentElement.clientWidth;
        if (width && width !== this.#plot.width)
            this.#plot.setSize({ width, height });
    }

    redraw() {
        if (!this.#plot)
            return;
        this.#plot.redraw(false, false);
        tellStep(this.#plot, this.#step());
    }

    destroy() {
        this.#plot?.destroy();
    }
}

const column = (steps, key) => steps.map((step) => step[key] ?? null);

const kinds = {
    distances: (steps, { subdomains }) => ({
        title:
            subdomains === 1
                ? "Estimated error of the solution"
                : `${steps.some((step) => step.v_mean !== undefined) ? "Distance" : "Estimated distance"} to the undecomposed flow`,
        unit: "mean edges",
        logarithmic: true,
        format: (value) => digits(value, 2),
        curves: [
            { name: "V_mean", values: column(steps, "v_mean"), colour: 1 },
            { name: "V_RMS", values: column(steps, "v_rms"), colour: 2 },
            { name: "V_max", values: column(steps, "v_max"), colour: 3 },
            { name: "H_mean", values: column(steps, "h_mean"), colour: 1, dash: [2, 3] },
            { name: "H_max", values: column(steps, "h_max"), colour: 3, dash: [2, 3] },
            { name: subdomains === 1 ? "largest" : "V_max, estimated", values: column(steps, "estimated_v_max"), colour: 4, dash: [5, 4] },
        ],
    }),
    displacements: (steps, report) => ({
        title: steps.length === 1 ? "Displacement" : "Displacement in each step",
        unit: `mean edges of the input${placesMeasured(report)}`,
        logarithmic: true,
        format: (value) => digits(value, 2),
        curves: [
            { name: "normal, mean", values: column(steps, "normal_mean"), colour: 1 },
            { name: "normal, largest", values: column(steps, "normal_max"), colour: 1, dash: [5, 4] },
            { name: "tangential, mean", values: column(steps, "tangential_mean"), colour: 2 },
            { name: "tangential, largest", values: column(steps, "tangential_max"), colour: 2, dash: [5, 4] },
        ],
    }),
    times: (steps, { subdomains, keep_edges: angle }) => ({
        title: steps.length === 1 ? "Time of the step" : "Time of each step",
        unit: "wall clock",
        format: seconds,
        curves: [
            { name: angle !== undefined ? "whole mesh" : subdomains > 1 ? "decomposed" : "undecomposed", values: column(steps, "seconds"), colour: 1 },
            { name: "undecomposed, to compare", values: column(steps, "reference_seconds"), colour: 4 },
        ],
    }),
};

function bars(entries, className) {
    const most = Math.max(...entries.map(([, value]) => value ?? 0), 1e-12);
    const list = element("div", { className: `bars ${className}` });
    for (const [name, value] of entries) {
        const bar = element("i");
        bar.style.width = `${(100 * (value ?? 0)) / most}%`;
        list.append(element("span", {}, name), bar, element("b", {}, seconds(value)));
    }
    return list;
}

function showPhases(section, report) {
    const all = report.seconds;
    const wall = [["read", all.read], ["set-up", all.setup], ["choose", all.choose], ["cut", all.cut], ["analyse", all.analyse], ["all steps", all.step], ["write", all.write]].filter(
        ([, value]) => value > 0,
    );
    if (all.interface > 0 && report.subdomains > 1)
        wall.splice(-1, 0, ["of these, Γ", all.interface]);
    const summed = ["assemble", "factorise", "solve", "correct"].map((phase) => [phase, all[phase]]);
    section.hidden = wall.length === 0;
    section.replaceChildren(element("h2", {}, "Time by phase ", element("small", {}, "wall clock")), bars(wall, ""));
    if (summed.some(([, value]) => value > 0))
        section.append(element("h2", {}, "In the steps ", element("small", {}, "summed over all threads")), bars(summed, "summed"));
    explain(section);
}

/** All plots of a flow. */
export class Plots {
    #plots = [];
    #places;

    constructor(places) {
        this.#places = places;
        new ResizeObserver(() => this.#plots.forEach((plot) => plot.resize())).observe(document.getElementById("distances").parentElement);
    }

    show(report) {
        this.#plots.forEach((plot) => plot.destroy());
        this.#plots = Object.entries(kinds).map(
            ([name, kind]) => new Plot(document.getElementById(name), kind(stepsOf(report), report), this.#places),
        );
        showPhases(document.getElementById("phases"), report);
    }

    redraw() {
        this.#plots.forEach((plot) => plot.redraw());
    }
}
