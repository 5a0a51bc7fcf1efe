// Words that a user may not know, told where the mouse, a finger or the keyboard points at them.

import { element } from "./facts.js";

const meanings = {
    "Γ": "The interface: all vertices that faces of different sub-meshes share.",
    "undecomposed": "The flow of the whole mesh in one piece, without sub-meshes: what a decomposed flow should come to.",
    "V_mean": "Mean distance of the vertices from where the undecomposed flow takes them, in mean edge lengths.",
    "V_RMS": "Root of the mean squared distance of the vertices from where the undecomposed flow takes them, in mean edge lengths.",
    "V_max": "Largest distance of a vertex from where the undecomposed flow takes it, in mean edge lengths.",
    "H_mean": "Mean distance of the undecomposed flow's vertices from the surface, in mean edge lengths.",
    "H_max": "Largest distance of a vertex of the undecomposed flow from the surface, in mean edge lengths.",
    "Roughness": "Root mean square of the angles between neighbouring faces.",
    "Noise": "How far vertices were found to be off the surface, as standard deviation along its normals.",
    "‖ΔV‖": "Length of the Laplacian of the positions, which is the mean curvature |κ₁ + κ₂|: 2/r on a sphere of radius r.",
    "mean edges": "Lengths in multiples of the mesh's mean edge length.",
    "Colour class": "Sub-meshes of one colour have no common interface and are solved at once; colours follow one another.",
};

const words = new RegExp(`(${Object.keys(meanings).join("|")})(?![\\p{L}])`, "iu");
const meaningOf = (word) => meanings[word] ?? meanings[Object.keys(meanings).find((key) => key.toLowerCase() === word.toLowerCase())];

/** Marks the known words below an element, each that is not in a word of another. */
export function explain(root) {
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    const texts = [];
    while (walker.nextNode())
        texts.push(walker.currentNode);
    for (const text of texts) {
        if (text.parentElement.closest("[data-meaning], option, code"))
            continue;
        const parts = text.data.split(words);
        if (parts.length > 1)
            text.replaceWith(...parts.map((part, k) => (k % 2 === 1 ? marked(part) : part)).filter(Boolean));
    }
    return root;
}

/** A word that the keyboard comes to. Within a label it is that of the label's input. */
function marked(word) {
    const made = element("span", { className: "word", tabIndex: 0 }, word);
    made.dataset.meaning = meaningOf(word);
    return made;
}

/** Shows meanings in `tip` as long as something points at their words; Esc takes one away. */
export function showMeanings(tip) {
    let shown = null;
    const hide = () => {
        tip.hidden = true;
        shown?.removeAttribute("aria-describedby");
        shown = null;
    };
    const settle = () => {
        if (shown === null)
            return;
        const place = shown.getBoundingClientRect();
        const { width, height } = tip.getBoundingClientRect();
        const left = Math.min(Math.max(place.left + place.width / 2 - width / 2, 6), document.documentElement.clientWidth - width - 6);
        const below = place.bottom + height + 4 < innerHeight;
        tip.style.left = `${left}px`;
        tip.style.top = `${below ? place.bottom : place.top - height}px`;
    };
    const show = ({ target }) => {
        const word = target.closest?.("[data-meaning]") ?? null;
        if (word === shown || tip.contains(target))
            return;
        hide();
        if (word === null)
            return;
        shown = word;
        word.setAttribute("aria-describedby", tip.id);
        tip.textContent = word.dataset.meaning;
        tip.hidden = false;
        settle();
    };
    document.addEventListener("pointerover", show);
    document.addEventListener("focusin", show);
    document.addEventListener("focusout", hide);
    document.addEventListener("scroll", settle, { capture: true, passive: true });
    document.addEventListener("keydown", ({ key }) => key === "Escape" && hide());
}
