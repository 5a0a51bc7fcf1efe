// Bundles the page into one HTML file with all scripts and styles in it, and that into a C++ source file.
//
//     node build.mjs NPM_FOLDER OUTPUT.cpp

import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const [npm, output] = process.argv.slice(2).map((path) => resolve(path));
const source = join(dirname(fileURLToPath(import.meta.url)), "src");
const modules = join(npm, "node_modules");
const esbuild = createRequire(join(npm, "package.json"))("esbuild");

function bundled(entry) {
    const result = esbuild.buildSync({
        entryPoints: [join(source, entry)],
        nodePaths: [modules],
        bundle: true,
        minify: true,
        write: false,
        charset: "ascii",
        format: "iife",
        target: "es2022",
        legalComments: "none",
        logLevel: "warning",
    });
    return result.outputFiles[0].text;
}

/** The licences of what is bundled, as they ask for. */
function notices() {
    return ["three", "uplot"]
        .map((name) => `${name}: ${readFileSync(join(modules, name, "LICENSE"), "utf8").trim()}`)
        .join("\n\n")
        .replaceAll("--", "- -");
}

/** A piece of text at the place of a mark that stands there once. */
function placed(html, mark, text) {
    const parts = html.split(mark);
    if (parts.length !== 2)
        throw new Error(`${mark} stands ${parts.length - 1} times in the page`);
    return parts[0] + text + parts[1];
}

/** Compilers need only take literals of 65,536 characters. */
function literals(text) {
    const pieces = [];
    const letters = Array.from(text);
    for (let k = 0; k < letters.length; k += 15000)
        pieces.push(`    R"seamflow(${letters.slice(k, k + 15000).join("")})seamflow"sv,`);
    return pieces.join("\n");
}

let html = readFileSync(join(source, "page.html"), "utf8");
html = placed(html, "{{notices}}", notices());
html = placed(html, "{{style}}", bundled("page.css"));
html = placed(html, "{{script}}", bundled("main.js").replaceAll("<!--", "\\x3C!--").replaceAll("</script", "<\\/script"));
for (const mark of ["{{title}}", "{{data}}"]) placed(html, mark, "");

writeFileSync(
    output,
    `// Made by samples/page/build.mjs from samples/page/src.

#include "samples/page/page_template.h"

#include <string_view>

namespace seamflow {

namespace {

// With their lengths: counting letters at compile time takes more steps than clang allows.
using namespace std::string_view_literals;
constexpr std::string_view pieces[] = {
${literals(html)}
};

std::string joined()
{
    std::string text;
    for (const std::string_view piece : pieces)
        text += piece;
    return text;
}

}  // namespace

const std::string& page_template()
{
    static const std::string form = joined();
    return form;
}

}  // namespace seamflow
`,
);
