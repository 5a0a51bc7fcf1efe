// What the page shows, as samples/page/packed_array.h and packed_state.h pack it.

export const facts = JSON.parse(document.getElementById("facts").textContent);

/** Bytes of a text in base64. */
function bytesOf(text) {
    if (Uint8Array.fromBase64)
        return Uint8Array.fromBase64(text);
    const letters = atob(text);
    const bytes = new Uint8Array(letters.length);
    for (let i = 0; i < bytes.length; ++i)
        bytes[i] = letters.charCodeAt(i);
    return bytes;
}

/** The bytes of a block. */
export async function unpackedBytes(block) {
    const stream = new Blob([bytesOf(document.getElementById(`block-${block}`).textContent)])
        .stream()
        .pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Adds up the differences of one column. @param put takes row and number. */
function undoColumn(bytes, begin, rows, width, put) {
    let now = 0;
    for (let row = 0; row < rows; ++row) {
        let folded = 0;
        for (let byte = width - 1; byte >= 0; --byte)
            folded = (folded << 8) | bytes[begin + byte * rows + row];
        now = (now + ((folded >>> 1) ^ -(folded & 1))) | 0;
        put(row, now);
    }
}

/** Numbers of 32 bits in rows of so many columns. */
export async function unpacked32(block, columns) {
    const bytes = await unpackedBytes(block);
    const numbers = new Uint32Array(bytes.length / 4);
    const rows = numbers.length / columns;
    for (let column = 0; column < columns; ++column)
        undoColumn(bytes, 4 * rows * column, rows, 4, (row, now) => {
            numbers[row * columns + column] = now;
        });
    return numbers;
}

/** Numbers of 16 bits in rows of so many columns, each row in `stride` numbers. */
export async function unpacked16(block, columns, stride) {
    const bytes = await unpackedBytes(block);
    const rows = bytes.length / 2 / columns;
    const numbers = new Uint16Array(rows * stride);
    for (let column = 0; column < columns; ++column)
        undoColumn(bytes, 2 * rows * column, rows, 2, (row, now) => {
            numbers[row * stride + column] = now & 65535;
        });
    return numbers;
}

/** A function that remembers its last few results by its argument. */
export function remembering(most, make) {
    const known = new Map();
    const remembered = (key) => {
        if (known.has(key)) {
            const value = known.get(key);
            known.delete(key);
            known.set(key, value);
            return value;
        }
        if (known.size >= most)
            known.delete(known.keys().next().value);
        const value = make(key);
        known.set(key, value);
        return value;
    };
    return Object.assign(remembered, { clear: () => known.clear() });
}
