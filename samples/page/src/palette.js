// Colours: of labels as in the files that smooth --parts writes, and ramps for what is measured.

/** Red, green and blue, 0 to 255, of "#rrggbb". */
export const rgb = (hex) => [1, 3, 5].map((place) => parseInt(hex.slice(place, place + 2), 16));

export const css = (colour) => `rgb(${colour.join(" ")})`;

/** As colour_of in partition/formats/palette.h. */
export function colourOfLabel(label) {
    const hue = (label * 0.6180339887498949) % 1;
    const brightness = [0.95, 0.75, 0.85][label % 3];
    return [0, 1, 2].map((k) => {
        const turn = Math.abs(hue - k / 3);
        const full = Math.min(Math.max(2 - 6 * Math.min(turn, 1 - turn), 0), 1);
        return Math.round(255 * brightness * (1 - 0.65 * (1 - full)));
    });
}

const classes = ["#c8503f", "#56616e", "#d9a531", "#3f84b5", "#5f9a54", "#8a5ba6"].map(rgb);

/** Red and black first, as in red-black order. */
export const colourOfClass = (index) => classes[index] ?? colourOfLabel(index);

const stops = {
    texture: ["#0000ff", "#00ffff", "#00ff00", "#ffff00", "#ff0000"],
    distance: ["#dde2e6", "#f2c861", "#e0703a", "#b02a50", "#541457"],
    field: ["#440154", "#482878", "#3e4a89", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"],  // viridis
    curvature: ["#e2e6ea", "#a5d3c6", "#4a9fb8", "#3561a0", "#2a2461"],
};

/** 256 colours from one end to the other, linear between the stops, RGBA. */
export function ramp(name) {
    const colours = stops[name].map(rgb);
    const bytes = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; ++i) {
        const place = (i / 255) * (colours.length - 1);
        const k = Math.min(Math.floor(place), colours.length - 2);
        for (let c = 0; c < 3; ++c)
            bytes[4 * i + c] = Math.round(colours[k][c] + (place - k) * (colours[k + 1][c] - colours[k][c]));
        bytes[4 * i + 3] = 255;
    }
    return bytes;
}

export const cssRamp = (name) => `linear-gradient(to right, ${stops[name].join(", ")})`;
