// Plays the steps one after another.

/** How long a state is shown, in milliseconds: a few seconds for all of them. */
const patience = (states) => Math.min(Math.max(4000 / states, 60), 700);

export class Player {
    #button;
    #states;
    #run = 0;
    #plays = false;

    /** @param states state() is the number of the one shown, states() of how many; choose(number) shows another. */
    constructor(button, states) {
        this.#button = button;
        this.#states = states;
        button.addEventListener("click", () => (this.#plays ? this.stop() : this.play()));
        this.#tell();
    }

    #tell() {
        this.#button.textContent = this.#plays ? "❚❚" : "▶";
        this.#button.setAttribute("aria-label", this.#plays ? "Pause" : "Play the steps");
    }

    stop() {
        ++this.#run;
        this.#plays = false;
        this.#tell();
    }

    /** From the state that is shown, or from the input if that is the last. */
    async play() {
        const mine = ++this.#run;
        const { state, states, choose } = this.#states;
        this.#plays = true;
        this.#tell();
        const shown = (number) => Promise.all([choose(number), new Promise((done) => setTimeout(done, patience(states())))]);
        if (state() >= states() - 1)
            await shown(0);
        while (mine === this.#run && state() < states() - 1)
            await shown(state() + 1);
        if (mine === this.#run)
            this.stop();
    }
}
