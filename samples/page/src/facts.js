// Words and numbers of the report.

/** A number with three digits, or a dash. */
export function digits(value, n = 3) {
    if (value === null || value === undefined || !Number.isFinite(value))
        return "–";
    if (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6)) {
        const [mantissa, power] = value.toExponential(n - 1).split("e");
        return `${Number(mantissa)}e${Number(power)}`;
    }
    return Number.isInteger(value) ? value.toLocaleString("en") : String(Number(value.toPrecision(n)));
}

/** Numbers with so many digits, three at least, that different ones are seen to be different. */
export function digitsOfEach(values) {
    const count = (list) => new Set(list).size;
    let n = 3;
    while (n < 17 && count(values.map((value) => Number(value.toPrecision(n)))) < count(values))
        ++n;
    return values.map((value) => digits(value, n));
}

export const seconds = (value) =>
    value === null || value === undefined ? "–" : value < 1 ? `${digits(1000 * value)} ms` : `${digits(value)} s`;

export function element(name, attributes = {}, ...children) {
    const made = Object.assign(document.createElement(name), attributes);
    made.append(...children);
    return made;
}

const counted = (n, one, many) => `${digits(n)} ${n === 1 ? one : many}`;

const laplacians = { "fujiwara": "Fujiwara", "alexa-wardetzky": "Alexa–Wardetzky", "virtual-refinement": "Virtual refinement", "ptackova-velho": "Ptáčková–Velho", "uniform": "of uniform weights" };

/** What a report says of its steps one by one; nothing of those of fields. */
export const stepsOf = ({ steps }) => (Array.isArray(steps) ? steps : []);

/** Whether a run smoothed between edges, on the whole mesh and without a Laplacian. */
export const keepsEdges = (report) => report.keep_edges !== undefined;

const nameOf = ({ laplacian }) => `Laplacian ${laplacians[laplacian] ?? laplacian}`;

/** How fields were made. */
const fieldWords = (report) =>
    report.steps === undefined
        ? ["distances along the surface"]
        : [nameOf(report), `${counted(report.steps, "step", "steps")} of ${digits(report.time_step)} length²`, ...(report.fwhm ? [`${digits(report.fwhm)} wide at half maximum`] : [])];

/** How much a flow smoothed. */
function amountOf(report) {
    if (report.steps.length === 0)
        return "nothing was smoothed";
    if (report.time_step === undefined)
        return report.noise > 0 ? "noise removed" : "no noise found";
    return `${counted(report.steps.length, "step", "steps")} of ${digits(report.time_step)} length²`;
}

/** One line about a flow. */
export function summary(mesh, report) {
    const size = `${counted(mesh.vertices, "vertex", "vertices")}, ${counted(mesh.faces, "face", "faces")}`;
    if (report.fields)
        return [size, ...fieldWords(report)].join(" · ");
    if (report.time_step === undefined)
        return [size, amountOf(report)].join(" · ");
    return [
        size,
        keepsEdges(report) ? `edges sharper than ${digits(report.keep_edges)}° kept` : nameOf(report),
        ...(report.flow && report.flow !== "mean-curvature" ? [report.flow] : []),
        ...(report.filter === "low-pass" ? ["low-pass"] : []),
        ...(report.attachment ? [`attached, ${digits(report.attachment)} / length²`] : []),
        ...(report.attachment_weights ? ["attached by weights"] : []),
        ...(report.rescale && report.rescale !== "none" ? [`${report.rescale} kept`] : []),
        amountOf(report),
        ...(keepsEdges(report) ? [] : [report.subdomains > 1 ? `${digits(report.subdomains)} sub-meshes${report.colours > 1 ? ` in ${report.colours} colours` : ""}` : "undecomposed"]),
    ].join(" · ");
}

/** "a → b (-3 %)", without the part where it says nothing. */
function change(before, after, unit = "") {
    const percent = 100 * (after / before - 1);
    const percents = Math.abs(percent) < 1e-6 ? "unchanged" : `${percent > 0 ? "+" : ""}${digits(percent, 2)} %`;
    const part = unit === "" && Number.isFinite(percent) ? ` (${percents})` : "";
    return `${digits(before, 4)}${unit} → ${digits(after, 4)}${unit}${part}`;
}

/** What became of each field, and of what it lacks. */
function outcomeOfFields({ fields, without_data: gaps, filled }) {
    const range = ({ vertices, least, most, mean }) => (vertices === 0 ? "no data" : `${digits(least)} to ${digits(most)}, mean ${digits(mean)}`);
    const list = Object.entries(fields).map(([name, { before, after }]) => [name, [before, after].filter(Boolean).map(range).join(" → ")]);
    if (gaps > 0)
        list.push(["No data", `at ${counted(gaps, "vertex", "vertices")}${filled > 0 ? `, of which ${digits(filled)} were filled` : ""}`]);
    return list;
}

/** What somebody wants to know who had a surface smoothed. */
function outcome(report) {
    const { before, after, moved_mean: mean, moved_max: largest } = report.surface;
    const list = [];
    if (report.preset)
        list.push(["Preset", report.preset]);
    if (report.noise !== undefined)
        list.push(["Noise", report.noise > 0 ? `${digits(report.noise)} mean edges` : "none found"]);
    list.push(
        ["Moved", `${digits(mean)} mean edges on average, ${digits(largest)} at most`],
        ["Roughness", change(before.roughness_rms, after.roughness_rms, "°")],
        ["Area", change(before.area, after.area)],
    );
    if (before.volume !== null && after.volume !== null)
        list.push(["Volume", change(before.volume, after.volume)]);
    if (after.self_intersections !== undefined)
        list.push(["Crossing", `${digits(before.self_intersections)} pairs of faces → ${digits(after.self_intersections)}`]);
    return list;
}

/** Fills a section with what became of the surface; hides it where that was not measured. */
export function showOutcome(section, report) {
    section.hidden = !report.fields && !(report.surface?.before.area > 0);
    if (section.hidden)
        return;
    const list = element("dl");
    for (const [name, text] of report.fields ? outcomeOfFields(report) : outcome(report))
        list.append(element("dt", {}, name), element("dd", {}, text));
    section.replaceChildren(element("h2", {}, "Result"), list);
}

/** Where motion and curvature are measured, if not everywhere. */
export const placesMeasured = (report) => `${report.region ? ", around the region" : ""}${report.junction_vertices > 0 ? ", except at junctions" : ""}`;

function rowsOfFlow(report, last) {
    const list = [
        ["Mean edge", `${digits(report.mean_edge)} (length)`],
        ["Amount", amountOf(report)],
    ];
    if (report.time_step !== undefined)
        list.push(["Time step", `${digits(report.time_step)} length² = ${digits(report.time_step / report.mean_edge ** 2)} squared mean edges`]);
    if (!keepsEdges(report) && report.time_step !== undefined)
        list.push(["Sub-meshes", report.subdomains === 1 ? "none: steps on the whole mesh" : `${digits(report.subdomains)}${report.colours > 1 ? ` in ${report.colours} colours` : ""}, ${counted(report.interface_vertices, "vertex", "vertices")} on Γ`]);
    if (report.tolerance !== undefined)
        list.push(["Steps", `converged to ${digits(report.tolerance)}; iterations ${report.steps.map((step) => step.iterations ?? "–").join(", ")}`]);
    if (last)
        list.push(["Largest ‖ΔV‖", `${digits(report.steps[0].max_mean_curvature_before)} before, ${digits(last.max_mean_curvature_after)} after (1/length)${placesMeasured(report)}`]);
    if (last?.v_mean !== undefined)
        list.push(["Distance", `V_mean ${digits(last.v_mean)}, V_RMS ${digits(last.v_rms)}, V_max ${digits(last.v_max)}${last.h_mean === undefined ? "" : `, H_mean ${digits(last.h_mean)}, H_max ${digits(last.h_max)}`} mean edges after the last step`]);
    return list;
}

function rows(report) {
    const last = stepsOf(report).at(-1);
    const list = [
        ["Input", report.input],
        ["Output", report.output],
    ];
    if (!report.fields)
        list.push(...rowsOfFlow(report, last));
    if (report.version !== undefined)
        list.push(["Made by", `seamflow ${report.version}, ${report.date}`]);
    if (!report.fields)
        list.push(["Threads", digits(report.threads)], ["Memory", `${digits(report.peak_memory_bytes / 1e6)} MB at most`]);
    if (report.arguments.length > 0)
        list.push(["Command", ["smooth", ...report.arguments].join(" ")]);
    return list;
}

/** Fills a section with what there is to know of a flow. */
export function showFacts(section, mesh, flow) {
    const { report } = flow;
    const list = element("dl");
    for (const [name, text] of rows(report))
        list.append(element("dt", {}, name), element("dd", {}, text));
    const remarks = element("ul");
    for (const remark of [...[...report.choices, ...report.remarks].map(({ text }) => text), flow.remark, ...mesh.remarks].filter((text, k, all) => text && all.indexOf(text) === k))
        remarks.append(element("li", {}, remark));
    section.replaceChildren(element("h2", {}, "Run"), list);
    if (remarks.childElementCount > 0)
        section.append(remarks);
}
