// Opens pages that smooth and figures write in a headless Chromium, and looks at what is drawn.
//
//     node page_test.mjs NPM_FOLDER CHROMIUM BIN_FOLDER OUTPUT_FOLDER
//
// The pages and screenshots stay in OUTPUT_FOLDER.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { deflateSync } from "node:zlib";

const [npm, chromium, bin, out] = process.argv.slice(2).map((path) => resolve(path));
const playwright = createRequire(join(npm, "package.json"))("playwright-core");

/** Nothing in a name may break a page; this one even ends a script, across a folder and a file. */
const awkward = join(out, "a<");
const sphere = join(awkward, `script>&"'<!--.ply`);
const page = (name) => join(out, `${name}.html`);

const program = (name, ...words) => execFileSync(join(bin, name), words.map(String), { stdio: "pipe" }).toString();

/** A PNG file of RGB rows. */
function png(rows) {
    const chunk = (type, data) => {
        const bytes = Buffer.concat([Buffer.alloc(4), Buffer.from(type, "latin1"), data, Buffer.alloc(4)]);
        bytes.writeUInt32BE(data.length);
        bytes.writeUInt32BE(crc32(bytes.subarray(4, 8 + data.length)), 8 + data.length);
        return bytes;
    };
    const size = Buffer.alloc(13);
    size.writeUInt32BE(rows[0].length);
    size.writeUInt32BE(rows.length, 4);
    size.set([8, 2], 8);
    const data = deflateSync(Buffer.from(rows.flatMap((row) => [0, ...row.flat()])));
    return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), chunk("IHDR", size), chunk("IDAT", data), chunk("IEND", Buffer.alloc(0))]);
}

const crc32 = (bytes) => {
    let sum = ~0;
    for (const byte of bytes) {
        sum ^= byte;
        for (let k = 0; k < 8; ++k)
            sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return ~sum >>> 0;
};

/** A square of quads that faces upwards in OBJ: an image, red below and blue above, on its left, green on its right. */
function writeTextured() {
    const n = 20;
    const red = [230, 20, 20];
    const blue = [20, 20, 230];
    writeFileSync(join(out, "map.png"), png([...Array(4).fill(Array(8).fill(blue)), ...Array(4).fill(Array(8).fill(red))]));
    writeFileSync(join(out, "textured.mtl"), "newmtl image\nKd 0 0 0\nmap_Kd map.png\nnewmtl green\nKd 0.1 0.9 0.1\n");
    const lines = ["mtllib textured.mtl"];
    const vertices = [];
    for (let j = 0; j <= n; ++j)
        for (let i = 0; i <= n; ++i) {
            const place = [i / n, 0.02 * Math.sin(9 * i + 5 * j), 1 - j / n];
            lines.push(`v ${place.join(" ")}`);
            vertices.push([...place, i < n / 2 ? "255 255 0" : "255 0 255"].join(" "));
        }
    for (let j = 0; j <= n; ++j)
        for (let i = 0; i <= n; ++i)
            lines.push(`vt ${i / n} ${j / n}`);
    const faces = [];
    for (const [name, from, to] of [["image", 0, n / 2], ["green", n / 2, n]]) {
        lines.push(`usemtl ${name}`);
        for (let j = 0; j < n; ++j)
            for (let i = from; i < to; ++i) {
                const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => a + b * (n + 1));
                lines.push(`f ${corners.map((v) => `${v + 1}/${v + 1}`).join(" ")}`);
                faces.push(`4 ${corners.join(" ")}`);
            }
    }
    writeFileSync(join(out, "textured.obj"), lines.join("\n"));
    const header = ["ply", "format ascii 1.0", `element vertex ${vertices.length}`, ...["float x", "float y", "float z", "uchar red", "uchar green", "uchar blue"].map((name) => `property ${name}`)];
    writeFileSync(join(out, "painted.ply"), [...header, `element face ${faces.length}`, "property list uchar int vertex_indices", "end_header", ...vertices, ...faces, ""].join("\n"));
}

/** A flat square in PLY: a field that is 0 on the left and 10 on the right, with a gap in the middle, its opposite, and colours. */
function writeFields() {
    const n = 40;
    const vertices = [];
    const faces = [];
    for (let j = 0; j <= n; ++j)
        for (let i = 0; i <= n; ++i) {
            const isLeft = i < n / 2;
            const value = Math.hypot(i - n / 2, j - n / 2) < n / 5 ? "nan" : isLeft ? 0 : 10;
            vertices.push(`${i / n} 0 ${1 - j / n} ${value} ${isLeft ? 10 : 0} ${isLeft ? "255 0 0" : "0 0 255"}`);
            if (i < n && j < n)
                faces.push(`4 ${[[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => a + b * (n + 1)).join(" ")}`);
        }
    const nearMillion = (line) => [...line.split(" ").slice(0, 3), 1e6 + 1e-6 * (line.split(" ")[4] / 5 - 1), "nan"].join(" ");
    const twoFields = ["ply", "format ascii 1.0", `element vertex ${vertices.length + 1}`, ...["float x", "float y", "float z", "double near", "float none"].map((name) => `property ${name}`)];
    const stray = "1000 0 1000 1e6 nan";
    writeFileSync(join(out, "odd.ply"), [...twoFields, `element face ${faces.length}`, "property list uchar int vertex_indices", "end_header", ...vertices.map(nearMillion), stray, ...faces, ""].join("\n"));
    const header = ["ply", "format ascii 1.0", `element vertex ${vertices.length}`, ...["float x", "float y", "float z", "float value", "float other", "uchar red", "uchar green", "uchar blue"].map((name) => `property ${name}`)];
    writeFileSync(join(out, "field.ply"), [...header, `element face ${faces.length}`, "property list uchar int vertex_indices", "end_header", ...vertices, ...faces, ""].join("\n"));
    writeFileSync(join(out, "from.txt"), "0\n");
}

/** A browser that draws without a graphics card. */
const launch = (...more) =>
    playwright.chromium.launch({
        executablePath: chromium,
        args: ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", ...more],
    });

let browser;
let reader;

before(async () => {
    rmSync(out, { recursive: true, force: true });
    mkdirSync(awkward, { recursive: true });
    program("generate", "noisy-sphere", sphere, "--vertices", 3000);
    program("generate", "mixed", join(out, "mixed.obj"), "--vertices", 1500);
    const sweeps = ["--time-step-edges", 4, "--converge", "never", "--steps", 4];
    program("smooth", sphere, join(out, "sphere.ply"), ...sweeps, "--subdomains", 6, "--reference", "--html", page("sphere"), "--parts", join(out, "parts.ply"));
    program("smooth", join(out, "mixed.obj"), join(out, "mixed-smooth.obj"), ...sweeps, "--subdomains", 5, "--html", page("mixed"));
    program("smooth", join(out, "mixed.obj"), join(out, "none.obj"), "--time-step", 1, "--steps", 0, "--html", page("none"));
    program("smooth", join(out, "mixed.obj"), join(out, "edges.obj"), "--keep-edges", 30, "--time-step-edges", 4, "--html", page("edges"));
    program("smooth", sphere, join(out, "round.ply"), "--flow", "conformalized", "--laplacian", "virtual-refinement", "--attach", 2, "--rescale", "area", "--time-step-edges", 4, "--html", page("round"));
    writeTextured();
    program("smooth", join(out, "textured.obj"), join(out, "t.obj"), ...sweeps, "--subdomains", 3, "--html", page("textured"));
    program("smooth", join(out, "painted.ply"), join(out, "p.ply"), ...sweeps, "--html", page("painted"));
    writeFields();
    program("smooth", join(out, "field.ply"), join(out, "f.ply"), "--fields", "value,other,colour", "--fwhm", 0.6, "--html", page("fields"));
    program("smooth", join(out, "odd.ply"), join(out, "o.ply"), "--fields", "near,none", "--fwhm", 0.01, "--html", page("odd"));
    program("smooth", join(out, "field.ply"), join(out, "d.ply"), "--from", join(out, "from.txt"), "--html", page("from"));
    program("smooth", sphere, join(out, "r.ply"), "--region", join(out, "from.txt"), "--feather", "20%", "--radius", "2%", "--html", page("region"));
    program("smooth", sphere, join(out, "g.ply"), "--time-step-edges", 1e5, "--steps", 9, "--html", page("gone"));
    program("figures", "--out", join(out, "figures"), "--html", "texture");
    browser = await launch();
    reader = await browser.newPage();
});

after(() => browser?.close());

/** Opens a page; whatever it complains about or asks for is kept in its `complaints`. */
async function open(path, { width = 1280, height = 800, colorScheme = "light", within = browser } = {}) {
    const opened = await within.newPage({ viewport: { width, height }, colorScheme });
    opened.complaints = [];
    opened.on("console", (message) => opened.complaints.push(`${message.type()}: ${message.text()}`));
    opened.on("pageerror", (error) => opened.complaints.push(error.message));
    opened.on("request", (request) => {
        if (request.url() !== pathToFileURL(path).href)
            opened.complaints.push(`request: ${request.url()}`);
    });
    opened.setDefaultTimeout(120000);
    await opened.goto(pathToFileURL(path).href);
    await settled(opened);
    return opened;
}

const settled = (opened) => opened.waitForSelector('#stage[aria-busy="false"]', { timeout: 60000 });

/** Waits until what was done has had time to be drawn, on a busy machine, too. */
const drawn = async (opened) => {
    await settled(opened);
    await opened.waitForTimeout(300);
    await opened.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
};

/** The picture of a part of a page, which stays in the reader: its number there, and how many colours it has. */
async function seen(opened, selector = "#frame") {
    await settled(opened);
    const png = (await opened.locator(selector).first().screenshot({ animations: "disabled" })).toString("base64");
    return reader.evaluate(async (base64) => {
        const image = new Image();
        image.src = `data:image/png;base64,${base64}`;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0);
        const pixels = new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer);
        globalThis.pictures ??= [];
        (globalThis.widths ??= []).push(image.width);
        return { number: pictures.push(pixels) - 1, colours: new Set(pixels).size };
    }, png);
}

/** The part of the pixels that are not the same. */
const difference = (a, b) =>
    reader.evaluate(
        ([first, second]) => {
            const [old, now] = [pictures[first], pictures[second]];
            return old.length === now.length ? old.reduce((sum, pixel, k) => sum + (pixel !== now[k]), 0) / old.length : 1;
        },
        [a.number, b.number],
    );

/** The part of the pixels that are not the same between two parts of the pictures' width. */
const differenceWithin = (a, b, from, to) =>
    reader.evaluate(
        ([first, second, left, right]) => {
            const [old, now, width] = [pictures[first], pictures[second], widths[first]];
            const inside = old.map((pixel, k) => (k % width >= left * width && k % width < right * width ? Number(pixel !== now[k]) : 0));
            return inside.reduce((sum, other) => sum + other, 0) / old.length;
        },
        [a.number, b.number, from, to],
    );

/** Looks at a page until its difference from an earlier picture is as wanted: a busy machine draws late. */
async function seenWith(opened, old, wanted) {
    const patience = Date.now() + 30000;
    for (;;) {
        const now = await seen(opened);
        const changed = await difference(old, now);
        if (wanted(changed) || Date.now() > patience)
            return { now, changed };
        await opened.waitForTimeout(100);
    }
}

/** What is seen of a page once that no longer changes, to compare with later: what came too early never comes again. */
async function seenAtRest(opened) {
    await drawn(opened);
    for (let old = await seen(opened), patience = Date.now() + 30000; ; ) {
        await drawn(opened);
        const now = await seen(opened);
        if ((await difference(old, now)) === 0 || Date.now() > patience)
            return now;
        old = now;
    }
}

/** Does something to a page and requires that the surface looks different afterwards. */
async function changes(opened, what, act, least = 0.01) {
    const old = await seen(opened);
    await act();
    const { now, changed } = await seenWith(opened, old, (part) => part >= least);
    assert.ok(changed >= least, `${what} changes ${changed} of the picture`);
    return now;
}

/** Requires that the surface looks as it did before. */
async function looksLike(opened, old) {
    assert.equal((await seenWith(opened, old, (part) => part === 0)).changed, 0);
}

/** The surface alone, without what lies over it. */
const bare = (opened) => opened.addStyleTag({ content: "#legend, #tools { visibility: hidden; }" });

const choose = (opened, surface) => opened.locator(`[name="surface"][value="${surface}"]`).check();

const setStep = (opened, value) =>
    opened.locator("#step").evaluate((slider, to) => {
        slider.value = to;
        slider.dispatchEvent(new Event("input", { bubbles: true }));
    }, value);

test("a page opens without complaints and without asking for anything", async () => {
    for (const path of [page("sphere"), page("mixed"), page("none"), join(out, "figures", "texture.html")]) {
        const opened = await open(path);
        const { colours } = await seen(opened);
        assert.ok(colours > 50, `${path} shows ${colours} colours`);
        await drawn(opened);
        assert.deepEqual(opened.complaints, [], path);
        await opened.close();
    }
});

test("names are shown as they are", async () => {
    const opened = await open(page("sphere"));
    assert.equal(await opened.title(), `script>&"'<!--.ply`);
    assert.equal(await opened.locator("h1").textContent(), `script>&"'<!--.ply`);
    assert.ok((await opened.locator("#facts-table").textContent()).includes(sphere));
    await opened.close();
});

test("every switch changes what is seen", async () => {
    const opened = await open(page("sphere"));
    await bare(opened);
    for (const colour of ["sub-mesh", "class", "distance", "texture", "curvature"])
        await changes(opened, colour, () => opened.selectOption("#colour", colour), 0.05);
    await changes(opened, "the range of the ramp", () => opened.selectOption("#range", "all"));
    await opened.selectOption("#colour", "plain");
    await changes(opened, "edges", () => opened.check("#edges"));
    await changes(opened, "no edges", () => opened.uncheck("#edges"));
    await changes(opened, "flat shading", () => opened.check("#flat"));
    await changes(opened, "smooth shading", () => opened.uncheck("#flat"));
    await changes(opened, "before", () => choose(opened, "before"));
    await changes(opened, "after", () => choose(opened, "after"));
    await opened.selectOption("#colour", "curvature");
    await changes(opened, "undecomposed", () => choose(opened, "undecomposed"), 0.003);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("the slider goes through the steps, and what is drawn comes again", async () => {
    const opened = await open(page("sphere"));
    await bare(opened);
    const last = await seenAtRest(opened);
    assert.equal(await opened.locator("#step-name").textContent(), "Step 4 of 4");
    for (const step of [3, 2, 1, 0])
        await changes(opened, `step ${step}`, () => setStep(opened, step), 0.005);
    assert.equal(await opened.locator("#step-name").textContent(), "Input");
    await setStep(opened, 4);
    await looksLike(opened, last);
    await choose(opened, "before");
    await setStep(opened, 2);
    assert.ok(await opened.locator('[value="after"]').isChecked());
    await opened.close();
});

test("a wipe shows before on its left and after on its right, in the steps that are played, too", async () => {
    const opened = await open(page("sphere"));
    await bare(opened);
    await opened.addStyleTag({ content: "#divider { opacity: 0; }" });
    const after = await seenAtRest(opened);
    await choose(opened, "before");
    const before = await seenAtRest(opened);
    await opened.check("#wipe");
    assert.ok(await opened.locator('[value="after"]').isChecked());
    // The left from that before, the right from that after, and the left from that after.
    const parts = async (now) => [await differenceWithin(now, before, 0, 0.48), await differenceWithin(now, after, 0.52, 1), await differenceWithin(now, after, 0, 0.48)];
    const requireParts = async (areRight) => {
        for (const patience = Date.now() + 30000; ; ) {
            const now = await parts(await seenAtRest(opened));
            if (areRight(now))
                return;
            assert.ok(Date.now() < patience, now.join());
        }
    };
    await requireParts(([left, right, other]) => left === 0 && right === 0 && other > 0.005);
    const divider = opened.locator("#divider");
    await divider.focus();
    await opened.keyboard.press("End");
    assert.equal(await divider.getAttribute("aria-valuenow"), "100");
    await looksLike(opened, before);
    await opened.keyboard.press("Home");
    await looksLike(opened, after);
    const { x, y, width, height } = await opened.locator("#frame").boundingBox();
    await opened.mouse.move(x + 4, y + height / 2);
    await opened.mouse.down();
    await opened.mouse.move(x + width / 2, y + height / 2, { steps: 4 });
    await opened.mouse.up();
    assert.equal(await divider.getAttribute("aria-valuenow"), "50");
    await setStep(opened, 1);
    await requireParts(([left, right]) => left === 0 && right > 0.005);
    await choose(opened, "before");
    assert.ok(await divider.isHidden());
    await looksLike(opened, before);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

/** The parts of the pixels in which one of red, green and blue is clearly the largest or the smallest, by sides. */
const hues = async (opened) => {
    const { number } = await seenAtRest(opened);
    return reader.evaluate((at) => {
        const width = widths[at];
        const found = {};
        pictures[at].forEach((pixel, k) => {
            const parts = [pixel & 255, (pixel >> 8) & 255, (pixel >> 16) & 255];
            const most = Math.max(...parts);
            if (most - Math.min(...parts) < 60)
                return;
            const name = parts.map((part) => (part > 0.5 * most ? 1 : 0)).join("");
            const height = pictures[at].length / width;
            const entry = (found[name] ??= { count: 0, x: 0, y: 0 });
            entry.count += 1 / pictures[at].length;
            entry.x += (k % width) / width;
            entry.y += Math.floor(k / width) / height;
        });
        for (const entry of Object.values(found)) {
            entry.x /= entry.count * pictures[at].length;
            entry.y /= entry.count * pictures[at].length;
        }
        return found;
    }, number);
};

test("a file's texture and materials lie where the file has them, and go with every step", async () => {
    const opened = await open(page("textured"));
    await bare(opened);
    assert.equal(await opened.locator("#colour").inputValue(), "file");
    for (const step of [4, 0]) {
        await setStep(opened, step);
        const { "100": red, "001": blue, "010": green } = await hues(opened);
        for (const part of [red, blue, green])
            assert.ok(part?.count > 0.02, JSON.stringify({ red, blue, green }));
        assert.ok(blue.y < red.y && red.x < green.x && blue.x < green.x, JSON.stringify({ red, blue, green }));
        assert.ok(Math.abs(red.count + blue.count - green.count) < 0.5 * green.count, JSON.stringify({ red, blue, green }));
    }
    await changes(opened, "sub-meshes", () => opened.selectOption("#colour", "sub-mesh"), 0.05);
    await changes(opened, "the file's texture", () => opened.selectOption("#colour", "file"), 0.05);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("a file's colours of vertices are shown", async () => {
    const opened = await open(page("painted"));
    await bare(opened);
    assert.equal(await opened.locator("#colour").inputValue(), "vertices");
    const { "110": yellow, "101": magenta } = await hues(opened);
    assert.ok(yellow?.count > 0.02 && magenta?.count > 0.02);
    assert.ok(yellow.x < magenta.x);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

/** The parts of the pixels that are grey, and darker than any ground, and that are nearly black. */
const greys = async (opened) => {
    const { number } = await seenAtRest(opened);
    return reader.evaluate((at) => {
        const all = Array.from(pictures[at], (pixel) => [pixel & 255, (pixel >> 8) & 255, (pixel >> 16) & 255]);
        const part = (is) => all.filter(is).length / all.length;
        return {
            grey: part((parts) => Math.max(...parts) - Math.min(...parts) < 12 && parts[0] > 50 && parts[0] < 190),
            dark: part((parts) => Math.max(...parts) < 70),
        };
    }, number);
};

test("a page of fields shows each one, before and after, with grey for no data", async () => {
    const opened = await open(page("fields"));
    await bare(opened);
    assert.deepEqual(await opened.locator("#colour option").allTextContents(), ["red, green, blue", "value", "other", "Plain"]);
    await choose(opened, "before");
    const { "100": red, "001": blue } = await hues(opened);
    assert.ok(red?.count > 0.05 && blue?.count > 0.05 && red.x < blue.x, JSON.stringify({ red, blue }));
    assert.ok((await greys(opened)).grey < 0.002);
    for (const [number, isRising] of [[1, true], [2, false]]) {
        await opened.selectOption("#colour", `field-${number}`);
        const { "101": least, "110": most, "010": between } = await hues(opened);
        assert.ok(least?.count > 0.03 && most?.count > 0.03 && !(between?.count > 0.02), JSON.stringify({ least, most, between }));
        assert.equal(least.x < most.x, isRising);
        const { grey } = await greys(opened);
        assert.ok(isRising ? grey > 0.01 : grey < 0.002, String(grey));
        const legend = await opened.locator("#legend").textContent();
        assert.match(legend, isRising ? /^value0510the same scale before and after; grey: no data$/ : /^other0510the same scale before and after$/);
    }
    // It has spread, to green in between, on the same scale.
    await changes(opened, "after", () => choose(opened, "after"), 0.05);
    assert.match(await opened.locator("#legend .ends").textContent(), /^0510$/);
    const { "011": teal, "010": green } = await hues(opened);
    assert.ok(teal?.count + green?.count > 0.02, JSON.stringify({ teal, green }));
    await opened.check("#wipe");
    const wiped = await seenAtRest(opened);
    await opened.uncheck("#wipe");
    await choose(opened, "before");
    assert.ok((await differenceWithin(await seenAtRest(opened), wiped, 0, 0.45)) < 0.002);
    assert.match(await opened.locator("#outcome").textContent(), /value0 to 10, mean .* → .*other0 to 10, mean .*No dataat \d+ vertices/);
    assert.match(await opened.locator("#summary").textContent(), /10 steps of .* wide at half maximum$/);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("a page of fields that hardly differ, or have no data, with a vertex far away that has no faces", async () => {
    const opened = await open(page("odd"));
    await bare(opened);
    assert.deepEqual(await opened.locator("#legend .ends span").allTextContents(), ["999999.999999", "1e6", "1.000000000001e6"]);
    const { "101": least, "110": most } = await hues(opened);
    assert.ok(least?.count > 0.03 && most?.count > 0.03, JSON.stringify({ least, most }));
    await opened.selectOption("#colour", "field-1");
    assert.equal(await opened.locator("#legend").textContent(), "noneno data");
    assert.equal(await opened.locator("#legend .ramp").count(), 0);
    assert.ok(await opened.locator("#range-choice").isHidden());
    assert.ok((await greys(opened)).grey > 0.05);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("a page of distances has lines at equal steps, and nothing before", async () => {
    const opened = await open(page("from"));
    await bare(opened);
    const { dark } = await greys(opened);
    assert.ok(dark > 0.005 && dark < 0.08, String(dark));
    const { "101": near, "110": far } = await hues(opened);
    assert.ok(near?.count > 0.002 && far?.count > 0.002 && near.x < far.x, JSON.stringify({ near, far }));
    assert.match(await opened.locator("#legend").textContent(), /^distance0.*a line every 0.1$/);
    for (const id of ["surfaces", "wipe", "play"])
        assert.ok(await opened.locator(`#${id}`).isHidden(), id);
    await opened.keyboard.press("w");
    assert.ok(await opened.locator("#divider").isHidden());
    assert.match(await opened.locator("#summary").textContent(), /faces · distances along the surface$/);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("play goes through all steps to the last, and stops when it is told to", async () => {
    const opened = await open(page("sphere"));
    const names = () => opened.evaluate(() => globalThis.names.splice(0));
    await opened.evaluate(() => {
        globalThis.names = [];
        const name = document.getElementById("step-name");
        new MutationObserver(() => names.at(-1) !== name.textContent && names.push(name.textContent)).observe(name, { childList: true });
    });
    await opened.locator("#play").click();
    await opened.waitForFunction(() => document.getElementById("play").ariaLabel.startsWith("Play"));
    assert.deepEqual(await names(), ["Input", "Step 1 of 4", "Step 2 of 4", "Step 3 of 4", "Step 4 of 4"]);
    await opened.keyboard.press("p");
    assert.match(await opened.locator("#play").getAttribute("aria-label"), /^Pause/);
    await setStep(opened, 2);
    assert.match(await opened.locator("#play").getAttribute("aria-label"), /^Play/);
    await opened.waitForTimeout(1500);
    assert.equal(await opened.locator("#step-name").textContent(), "Step 2 of 4");
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("keys do what the list of them says, which ? opens and Esc closes", async () => {
    const opened = await open(page("sphere"));
    const help = opened.locator("#help");
    assert.ok(await help.isHidden());
    await opened.keyboard.press("?");
    assert.ok(await help.isVisible());
    assert.equal(await help.locator("kbd").count(), await help.locator("dd").count());
    const step = await opened.locator("#step-name").textContent();
    await opened.keyboard.press(",");
    assert.equal(await opened.locator("#step-name").textContent(), step);
    await opened.keyboard.press("Escape");
    assert.ok(await help.isHidden());
    await opened.locator("#ask").click();
    assert.ok(await help.isVisible());
    await opened.keyboard.press("Escape");
    const up = await opened.locator("#up").inputValue();
    const checks = {
        b: () => opened.locator('[value="before"]').isChecked(),
        u: () => opened.locator('[value="undecomposed"]').isChecked(),
        a: () => opened.locator('[value="after"]').isChecked(),
        w: () => opened.locator("#divider").isVisible(),
        e: () => opened.locator("#edges").isChecked(),
        f: () => opened.locator("#flat").isChecked(),
        ",": async () => (await opened.locator("#step-name").textContent()) === "Step 3 of 4",
        ".": async () => (await opened.locator("#step-name").textContent()) === "Step 4 of 4",
        c: async () => (await opened.locator("#colour").inputValue()) !== "plain",
        z: async () => (await opened.locator("#up").inputValue()) !== up,
    };
    for (const [key, isDone] of Object.entries(checks)) {
        assert.ok(key === "." || key === "a" || !(await isDone()), key);
        await opened.keyboard.press(key);
        await settled(opened);
        assert.ok(await isDone(), key);
    }
    await opened.locator("#colour").focus();
    await opened.keyboard.press("w");
    assert.ok(await opened.locator("#divider").isVisible(), "a key within a list is the list's");
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("the view is saved as a picture under the name of the mesh", async () => {
    const opened = await open(page("mixed"));
    await bare(opened);
    const saving = opened.waitForEvent("download");
    await opened.evaluate(() => document.getElementById("picture").click());
    const download = await saving;
    assert.equal(download.suggestedFilename(), "mixed.png");
    const png = readFileSync(await download.path());
    const saved = await reader.evaluate(async (base64) => {
        const image = new Image();
        image.src = `data:image/png;base64,${base64}`;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0);
        const pixels = context.getImageData(0, 0, image.width, image.height).data;
        return { width: image.width, colours: new Set(new Uint32Array(pixels.buffer)).size, corner: [...pixels.slice(0, 4)] };
    }, png.toString("base64"));
    assert.equal(saved.width, await opened.locator("#canvas").evaluate((canvas) => canvas.width));
    assert.ok(saved.colours > 50, String(saved.colours));
    assert.deepEqual(saved.corner, [255, 255, 255, 255]);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("any axis can be upwards", async () => {
    const opened = await open(page("mixed"));
    await bare(opened);
    assert.deepEqual(await opened.locator("#up option").allTextContents(), ["+X", "−X", "+Y", "−Y", "+Z", "−Z"]);
    const first = await opened.locator("#up").inputValue();
    const old = await seenAtRest(opened);
    const others = (await opened.locator("#up option").allTextContents()).filter((name) => name !== first);
    for (const name of others)
        await changes(opened, name, () => opened.locator("#up").evaluate((list, value) => ((list.value = value), list.dispatchEvent(new Event("change"))), name));
    await opened.locator("#up").evaluate((list, value) => ((list.value = value), list.dispatchEvent(new Event("change"))), first);
    await looksLike(opened, old);
    await opened.close();
});

test("a mesh stands on its flat base, else as its format has it", async () => {
    const { guessUp } = await import(new URL("../../samples/page/src/upright.js", import.meta.url));
    /** A box whose side at the end of an axis is flat, with the centres of all others pulled in. */
    const box = (axis, end, size) => {
        const points = [];
        for (let corner = 0; corner < 8; ++corner)
            points.push([0, 1, 2].map((k) => ((corner >> k) & 1) * 65535));
        const corners = [];
        for (let k = 0; k < 3; ++k)
            for (const side of [0, 1]) {
                const [a, b, c, d] = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([u, v]) => (side << k) | (u << (k + 1) % 3) | (v << (k + 2) % 3));
                const centre = [0, 1, 2].map((other) => (other === k ? (k === axis && side === end ? side * 65535 : 32768 + (side ? 9000 : -9000)) : 32768));
                const m = points.push(centre) - 1;
                corners.push(a, b, m, b, c, m, c, d, m, d, a, m);
            }
        return [Uint16Array.from(points.flatMap((point) => [...point, 0])), size, Uint32Array.from(corners)];
    };
    for (let axis = 0; axis < 3; ++axis)
        for (const name of ["a.obj", "a.stl"]) {
            assert.deepEqual(guessUp(...box(axis, 0, [1, 1, 1]), name), { axis, sign: 1 });
            assert.deepEqual(guessUp(...box(axis, 1, [1, 1, 1]), name), { axis, sign: -1 });
        }
    const slope = [Uint16Array.from([0, 0, 0, 0, 65535, 0, 65535, 0, 0, 65535, 65535, 0]), [1, 1, 0.6]];
    assert.deepEqual(guessUp(...slope, Uint32Array.from([0, 1, 2]), "a.obj"), { axis: 2, sign: 1 });
    const round = (size, name) => guessUp(...box(3, 0, size), name);
    assert.deepEqual(round([1, 1, 1], "a.obj.gz"), { axis: 1, sign: 1 });
    for (const name of ["a.ply", "a.stl", "a.off"])
        assert.deepEqual(round([1, 1, 1], name), { axis: 2, sign: 1 });
    assert.deepEqual(round([1, 0.3, 1], "a.ply"), { axis: 1, sign: 1 });
    assert.deepEqual(round([1, 2, 1], "a.ply"), { axis: 1, sign: 1 });
    assert.deepEqual(guessUp(new Uint16Array(4), [0, 0, 0], new Uint32Array(0), "a.ply"), { axis: 2, sign: 1 });
});

test("shading is smooth but for creases, and sub-meshes leave no seams in it", async () => {
    const source = new URL("../../samples/page/src/", import.meta.url);
    const { drawableTriangles } = await import(new URL("faces.js", source));
    const { creases, vertexNormals } = await import(new URL("normals.js", source));
    // A ridge of two squares that meet at vertices 1 and 2, whose outer sides are `drop` lower.
    const ridge = (drop) => Uint16Array.from([0, 0, 1000 - drop, 0, 1000, 0, 1000, 0, 1000, 1000, 1000, 0, 0, 1000, 1000 - drop, 0, 2000, 0, 1000 - drop, 0, 2000, 1000, 1000 - drop, 0]);
    const corners = Uint32Array.from([0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2]);
    const labels = Uint32Array.from([0, 0, 1, 1]);
    for (const [drop, isCrease] of [[300, false], [500, true]]) {
        const { groups, share } = creases(corners, ridge(drop), [1, 1, 1], 6);
        assert.equal(share, isCrease ? 2 / 6 : 0);
        const { index, smooth, smoothOf, vertexOf } = drawableTriangles(corners, groups, labels, 6);
        const normals = vertexNormals(smooth.corners, smooth.vertexOf, ridge(drop), [1, 1, 1]);
        const atRidge = Array.from(index).filter((v) => vertexOf[v] === 1).map((v) => normals.slice(4 * smoothOf[v], 4 * smoothOf[v] + 3).join());
        assert.equal(atRidge.length, 3);
        assert.equal(new Set(atRidge).size, isCrease ? 2 : 1);
        const [x, , z] = normals.slice(0, 3);
        assert.ok(Math.abs(-x / z - drop / 1000) < (isCrease ? 1e-3 : 1), `${x} ${z}`);
    }
});

test("on a phone a finger that moves up scrolls past the surface, and sideways turns it", async () => {
    const phone = await browser.newContext({ viewport: { width: 400, height: 800 }, hasTouch: true, isMobile: true });
    const opened = await open(page("sphere"), { within: { newPage: () => phone.newPage() } });
    await bare(opened);
    const session = await phone.newCDPSession(opened);
    const { x, y, width, height } = await opened.locator("#canvas").boundingBox();
    const swipe = async (dx, dy) => {
        const at = (part) => [{ x: x + width / 2 + part * dx, y: y + height / 2 + part * dy }];
        await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: at(0) });
        for (let k = 1; k <= 10; ++k) {
            await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: at(k / 10) });
            await opened.waitForTimeout(20);
        }
        await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    };
    await seenAtRest(opened);
    await changes(opened, "a finger sideways", () => swipe(-120, 0), 0.05);
    assert.equal(await opened.evaluate(() => scrollY), 0);
    await swipe(0, -200);
    await opened.waitForFunction(() => scrollY > 100, null, { timeout: 30000 });
    assert.deepEqual(opened.complaints, []);
    await phone.close();
});

test("the surface is turned, brought nearer, moved, and put back", async () => {
    const opened = await open(page("mixed"));
    await bare(opened);
    const first = await seenAtRest(opened);
    const drag = async (button) => {
        await opened.mouse.move(400, 400);
        await opened.mouse.down({ button });
        await opened.mouse.move(520, 460, { steps: 4 });
        await opened.mouse.up({ button });
    };
    await changes(opened, "turning", () => drag("left"), 0.05);
    await changes(opened, "moving", () => drag("right"), 0.05);
    await changes(opened, "coming nearer", async () => {
        await opened.mouse.wheel(0, -400);
        await drawn(opened);
    }, 0.05);
    await opened.locator("#reset").evaluate((button) => button.click());
    await drawn(opened);
    await looksLike(opened, first);
    await opened.close();
});

test("legends tell what is seen, its range and its unit", async () => {
    const opened = await open(page("sphere"));
    const legend = () => opened.locator("#legend").textContent();
    const report = await opened.evaluate(() => JSON.parse(document.getElementById("facts").textContent).flows[0].report);
    assert.equal(await legend(), "");
    await opened.selectOption("#colour", "sub-mesh");
    assert.equal(await opened.locator("#legend li").count(), report.subdomains);
    await opened.selectOption("#colour", "class");
    assert.equal(await opened.locator("#legend li").count(), report.colours);
    await opened.selectOption("#colour", "distance");
    await opened.selectOption("#range", "largest");
    assert.match(await legend(), /^Distance to the undecomposed flow.*in mean edge lengths/);
    const end = Number((await opened.locator("#legend .ends span").last().textContent()).replaceAll(",", ""));
    assert.ok(Math.abs(end - report.steps[3].v_max) <= 0.01 * end, `${end} is not ${report.steps[3].v_max}`);
    await opened.selectOption("#colour", "curvature");
    assert.match(await legend(), /^Mean curvature.*in 1\/length/);
    await opened.close();
});

test("what is measured begins with what became of the surface, and ends with the times", async () => {
    const opened = await open(page("sphere"));
    const sections = await opened.locator("aside section:visible").evaluateAll((all) => all.map((section) => section.id));
    assert.equal(sections[0], "outcome");
    assert.deepEqual(sections.slice(-2), ["times", "phases"]);
    const { surface } = await opened.evaluate(() => JSON.parse(document.getElementById("facts").textContent).flows[0].report);
    const said = await opened.locator("#outcome").textContent();
    for (const word of ["Moved", "Roughness", "Area", "Volume"])
        assert.ok(said.includes(word), `${said} has ${word}`);
    const numbers = (text) => [...text.matchAll(/\d[\d.,]*/g)].map(([number]) => Number(number.replaceAll(",", "")));
    const [before, after] = numbers(said.slice(said.indexOf("Roughness")));
    assert.ok(Math.abs(before / surface.before.roughness_rms - 1) < 1e-3 && Math.abs(after / surface.after.roughness_rms - 1) < 1e-3);
    const [mean, largest] = numbers(said.slice(said.indexOf("Moved")));
    assert.ok(Math.abs(mean / surface.moved_mean - 1) < 1e-2 && Math.abs(largest / surface.moved_max - 1) < 1e-2);
    await opened.close();
    // Figures do not measure that.
    const figure = await open(join(out, "figures", "texture.html"));
    assert.ok(await figure.locator("#outcome").isHidden());
    await figure.close();
});

test("a page says which flow was taken", async () => {
    const summary = async (name) => (await open(page(name))).locator("#summary").textContent();
    assert.match(await summary("edges"), /faces · edges sharper than 30° kept · 1 step of [^·]*$/);
    assert.match(await summary("round"), /Laplacian Virtual refinement · conformalized · attached, 0.25 \/ length² · area kept · 1 step/);
});

test("a page says where motion is measured, what stayed, and if nothing is left to see", async () => {
    const region = await open(page("region"));
    assert.match(await region.locator("#displacements h2").textContent(), /of the input, around the region$/);
    await region.close();
    const round = await open(page("round"));
    assert.match(await round.locator("#displacements h2").textContent(), /of the input$/);
    assert.match(await round.locator("#outcome").textContent(), /Area\S+ → \S+ \(unchanged\)Volume/);
    assert.match(await round.locator("#facts-table").textContent(), /Sub-meshesnone: steps on the whole mesh/);
    assert.equal(await round.locator("#message").textContent(), "");
    await round.close();
    const gone = await open(page("gone"));
    assert.equal(await gone.locator("#message").textContent(), "The surface has shrunk to a point.");
    await choose(gone, "before");
    await settled(gone);
    assert.equal(await gone.locator("#message").textContent(), "");
    await gone.close();
});

test("without the undecomposed flow a page shows displacements", async () => {
    const opened = await open(page("mixed"));
    assert.ok(await opened.getByText("Undecomposed", { exact: true }).isHidden());
    assert.match(await opened.locator('#colour option[value="distance"]').textContent(), /^Displacement from the input/);
    await bare(opened);
    await changes(opened, "displacement", () => opened.selectOption("#colour", "distance"), 0.05);
    await opened.selectOption("#colour", "plain");
    await changes(opened, "edges of polygons", () => opened.check("#edges"));
    assert.match(await opened.locator("#distances h2").textContent(), /^Estimated distance/);
    await opened.close();
});

test("plots have a curve for all that was measured", async () => {
    const opened = await open(page("sphere"));
    const curves = async (id) => (await opened.locator(`#${id} .u-series`).count()) - 1;
    assert.equal(await curves("distances"), 6);
    assert.equal(await curves("displacements"), 4);
    assert.equal(await curves("times"), 2);
    for (const id of ["distances", "displacements", "times"])
        assert.ok((await seen(opened, `#${id} canvas`)).colours > 20, id);
    assert.equal(await opened.locator("#phases i").count(), 10);
    await setStep(opened, 1);
    await settled(opened);
    assert.equal(await opened.locator("#times .u-value").first().textContent(), "1");
    await opened.locator("#times .u-over").click({ position: { x: 20, y: 40 } });
    await settled(opened);
    assert.equal(await opened.locator("#step-name").textContent(), "Step 1 of 4");
    await opened.close();
});

test("no two curves of a plot have one name", async () => {
    const opened = await open(page("sphere"));
    for (const id of ["distances", "displacements", "times"]) {
        const names = await opened.locator(`#${id} .u-label`).allTextContents();
        assert.equal(new Set(names).size, names.length, names.join());
    }
    await opened.close();
});

test("one step is told in numbers, and charts without anything in them are not shown", async () => {
    const one = await open(page("round"));
    assert.equal(await one.locator("#distances canvas, #displacements canvas, #times canvas").count(), 0);
    const { steps } = await one.evaluate(() => JSON.parse(document.getElementById("facts").textContent).flows[0].report);
    const shown = await one.locator("#displacements dd").allTextContents();
    assert.equal(shown.length, 4);
    for (const [k, name] of ["normal_mean", "normal_max", "tangential_mean", "tangential_max"].entries())
        assert.ok(Math.abs(Number(shown[k]) - steps[0][name]) <= 0.05 * steps[0][name], `${name}: ${shown[k]}`);
    assert.equal(await one.locator("#times dd").count(), 1);
    await one.close();
    const none = await open(page("none"));
    for (const id of ["distances", "displacements", "times"])
        assert.ok(await none.locator(`#${id}`).isHidden(), id);
    for (const width of await none.locator("#phases i").evaluateAll((bars) => bars.map((bar) => bar.style.width)))
        assert.notEqual(width, "0%");
    await none.close();
});

test("words are explained to the mouse, the keyboard and screen readers", async () => {
    const opened = await open(page("sphere"));
    const tip = opened.locator("#tip");
    const word = (text) => opened.locator("[data-meaning]", { hasText: new RegExp(`^${text}$`) }).first();
    assert.ok(await tip.isHidden());
    for (const [text, meaning] of [["Γ", /interface/], ["V_max", /largest distance/i], ["undecomposed", /one piece/]]) {
        await word(text).hover();
        assert.match(await tip.textContent(), meaning);
        assert.ok(await tip.isVisible());
        assert.equal(await word(text).getAttribute("aria-describedby"), "tip");
        await opened.mouse.move(5, 5);
        assert.ok(await tip.isHidden(), text);
        await word(text).focus();
        assert.ok(await tip.isVisible());
        await opened.keyboard.press("Escape");
        assert.ok(await tip.isHidden());
    }
    const box = async () => (await opened.locator("#surfaces label").last().hover(), tip.boundingBox());
    assert.ok((await box()).x >= 0);
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("a page of a figure has all its flows", async () => {
    const opened = await open(join(out, "figures", "texture.html"));
    const flows = await opened.locator("#flow option").count();
    assert.ok(flows >= 6, `${flows} flows`);
    await bare(opened);
    await opened.selectOption("#colour", "distance");
    await opened.selectOption("#flow", String(flows - 1));
    await settled(opened);
    const legend = await opened.locator("#legend").textContent();
    assert.match(legend, /^Distance to the undecomposed flow/);
    await changes(opened, "another flow", () => opened.selectOption("#flow", "0"));
    await changes(opened, "sub-meshes", async () => {
        await opened.selectOption("#flow", String(flows - 1));
        await settled(opened);
        await opened.selectOption("#colour", "sub-mesh");
    });
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("a page of a figure opens on a decomposed flow, under its texture", async () => {
    const opened = await open(join(out, "figures", "texture.html"));
    const name = () => opened.locator("#flow option:checked").textContent();
    assert.equal(await name(), "Δ_F in two sub-meshes, adapted Robin");
    assert.match(await opened.locator("#summary").textContent(), /2 sub-meshes/);
    assert.match(await opened.locator("#legend").textContent(), /^Texture/);
    assert.match(await opened.locator("#facts-table").textContent(), /smooth texture-input\.ply out\.ply --laplacian fujiwara/);
    const times = () => opened.locator("#times dt").allTextContents();
    assert.ok((await times()).includes("decomposed"));
    await bare(opened);
    await changes(opened, "no texture", () => opened.selectOption("#colour", "plain"), 0.05);
    await opened.selectOption("#flow", "0");
    await settled(opened);
    assert.equal(await name(), "Δ_F, undecomposed");
    assert.ok(!(await times()).includes("decomposed"), (await times()).join());
    assert.deepEqual(opened.complaints, []);
    await opened.close();
});

test("the index of figures opens without complaints, with all its pictures", async (t) => {
    if (!existsSync(join(out, "figures", "texture-input.png"))) {
        t.skip("there is no Matplotlib");
        return;
    }
    const path = join(out, "figures", "index.html");
    const opened = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    const complaints = [];
    opened.on("console", (message) => complaints.push(message.text()));
    opened.on("requestfailed", (request) => complaints.push(request.url()));
    await opened.goto(pathToFileURL(path).href);
    const widths = await opened.locator("img").evaluateAll((images) => images.map((image) => image.naturalWidth));
    assert.equal(widths.length, 12);
    assert.ok(widths.every((width) => width > 0), widths.join());
    assert.equal(await opened.evaluate(() => document.documentElement.scrollWidth), 1280);
    assert.deepEqual(complaints, []);
    await opened.close();
});

test("pages fit phones and dark rooms", async () => {
    for (const [name, options] of [
        ["desk", {}],
        ["desk-dark", { colorScheme: "dark" }],
        ["phone", { width: 390, height: 844 }],
        ["phone-dark", { width: 390, height: 844, colorScheme: "dark" }],
    ]) {
        const opened = await open(page("sphere"), options);
        await opened.selectOption("#colour", "sub-mesh");
        await settled(opened);
        const [wide, window] = await opened.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
        assert.ok(wide <= window, `${name} is ${wide} wide`);
        const luminance = await opened.evaluate(() => Number(getComputedStyle(document.body).backgroundColor.match(/\d+/)[0]));
        assert.equal(luminance < 128, name.endsWith("dark"));
        await opened.screenshot({ path: join(out, `${name}.png`), fullPage: name.startsWith("phone") });
        await opened.close();
    }
});

test("without WebGL a page says so and shows the rest", async () => {
    const poor = await launch("--disable-3d-apis");
    try {
        const opened = await open(page("sphere"), { within: poor });
        assert.match(await opened.locator("#message").textContent(), /WebGL 2/);
        assert.equal(await opened.locator("#times canvas").count(), 1);
        await opened.close();
    } finally {
        await poor.close();
    }
});

test("every triangle has the sub-mesh of its face at its last vertex", async () => {
    const source = new URL("../../samples/page/src/", import.meta.url);
    const { withFlatLabels } = await import(new URL("faces.js", source));
    const corners = Uint32Array.from([0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 1, 2, 5, 2, 3, 5]);
    const labels = Uint32Array.from([0, 1, 2, 3, 0, 1]);
    const { index, doubled, labels: ofVertices } = withFlatLabels(corners, labels, 6);
    for (let t = 0; t < labels.length; ++t) {
        assert.equal(ofVertices[index[3 * t + 2]], labels[t]);
        const original = (v) => (v < 6 ? v : doubled[v - 6]);
        const turned = [0, 1, 2].map((k) => original(index[3 * t + k]));
        const as = [0, 1, 2].map((k) => corners[3 * t + k]);
        const first = turned.indexOf(as[0]);
        assert.deepEqual([0, 1, 2].map((k) => turned[(first + k) % 3]), as);
    }
});

test("sub-meshes have the colours that --parts gives them", async () => {
    const { colourOfLabel } = await import(new URL("../../samples/page/src/palette.js", import.meta.url));
    const file = readFileSync(join(out, "parts.ply"));
    const header = file.subarray(0, file.indexOf("end_header\n")).toString();
    const count = (name) => Number(header.match(new RegExp(`element ${name} (\\d+)`))[1]);
    const begin = header.length + "end_header\n".length + 24 * count("vertex");
    const face = (file.length - begin) / count("face");
    const labels = new Set();
    for (let place = begin; place < file.length; place += face) {
        const label = file.readInt32LE(place + face - 4);
        labels.add(label);
        assert.deepEqual(colourOfLabel(label), [...file.subarray(place + face - 7, place + face - 4)]);
    }
    assert.equal(labels.size, 6);
});
