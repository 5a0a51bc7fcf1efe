// The boundary between before and after, which mouse, finger and arrow keys move.

export class Wipe {
    #divider;
    #changed;
    /** Of the width, from the left. */
    part = 0.5;

    /** @param changed called with the part. */
    constructor(divider, changed) {
        this.#divider = divider;
        this.#changed = changed;
        this.#put(this.part);
        divider.addEventListener("pointerdown", (event) => {
            divider.setPointerCapture(event.pointerId);
            event.preventDefault();
            divider.focus();
        });
        divider.addEventListener("pointermove", (event) => {
            if (!divider.hasPointerCapture(event.pointerId))
                return;
            const { left, width } = divider.parentElement.getBoundingClientRect();
            this.#move((event.clientX - left) / width);
        });
        divider.addEventListener("keydown", (event) => {
            const step = { ArrowLeft: -0.02, ArrowDown: -0.02, ArrowRight: 0.02, ArrowUp: 0.02, PageDown: -0.1, PageUp: 0.1, Home: -1, End: 1 }[event.key];
            if (step === undefined)
                return;
            event.preventDefault();
            this.#move(this.part + step);
        });
    }

    #move(part) {
        this.#put(part);
        this.#changed(this.part);
    }

    #put(part) {
        this.part = Math.min(Math.max(part, 0), 1);
        const percent = Math.round(100 * this.part);
        this.#divider.style.left = `${100 * this.part}%`;
        this.#divider.setAttribute("aria-valuenow", percent);
        this.#divider.setAttribute("aria-valuetext", `before: ${percent} % of the width`);
    }
}
