// Keys, and the list of them.

import { element } from "./facts.js";

const byId = (id) => document.getElementById(id);
const click = (id) => () => byId(id).click();
const surface = (name) => () => document.querySelector(`[name="surface"][value="${name}"]:enabled`)?.click();

/** Takes the next entry of a list, and after the last the first. */
const next = (id) => () => {
    const list = byId(id);
    list.selectedIndex = (list.selectedIndex + 1) % list.options.length;
    list.dispatchEvent(new Event("change", { bubbles: true }));
};

/** @param step called with 1 or -1 for one step further or back. */
const shortcuts = (step) => [
    ["b", "before", surface("before")],
    ["a", "after", surface("after")],
    ["u", "undecomposed, where that was run", surface("undecomposed")],
    ["w", "wipe between before and after", click("wipe")],
    ["p", "play the steps, or pause", click("play")],
    [",", "one step back", () => step(-1)],
    [".", "one step further", () => step(1)],
    ["c", "next colour", next("colour")],
    ["e", "edges", click("edges")],
    ["f", "flat or smooth shading", click("flat")],
    ["z", "another axis upwards", next("up")],
    ["r", "reset the view", click("reset")],
    ["s", "save the view as PNG", click("picture")],
    ["?", "this list; Esc closes it", click("ask")],
];

/** @param help the dialog that has the list. @param step see shortcuts. */
export function listenToKeys(help, step) {
    const list = shortcuts(step);
    const close = element("button", { type: "button", autofocus: true }, "Close");
    close.addEventListener("click", () => help.close());
    help.append(
        element("h2", {}, "Keyboard shortcuts"),
        element("dl", {}, ...list.flatMap(([key, words]) => [element("dt", {}, element("kbd", {}, key)), element("dd", {}, words)])),
        close,
    );
    byId("ask").addEventListener("click", () => (help.open ? help.close() : help.showModal()));
    document.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || event.repeat || event.target.matches("select"))
            return;
        const found = list.find(([key]) => key === event.key.toLowerCase());
        if (found === undefined || (help.open && found[0] !== "?"))
            return;
        event.preventDefault();
        found[2]();
    });
}
