// What is drawn of the faces: triangles of which each has one colour although vertices are shared, and edges.
//
// WebGL takes what is flat from the last vertex of a triangle. So each vertex gets a sub-mesh to stand for, and every
// triangle is turned until its last vertex stands for its own; only along seams vertices are doubled for that.

/** The sub-mesh, or the material, of each triangle: that of its face. @param perFace into how many triangles each face is cut. */
export function labelsOfTriangles(labels, perFace, nTriangles) {
    const result = new Uint32Array(nTriangles);
    for (let f = 0, t = 0; f < perFace.length; ++f)
        for (let k = 0; k < perFace[f]; ++k)
            result[t++] = labels[f] ?? 0;
    return result;
}

/**
 * @param corners three vertices per triangle. @param labels one per triangle.
 * @returns index: the triangles, turned; doubled: for each vertex after the n first the one it is a copy of; labels: of
 *     all vertices, those of the mesh and the doubled ones.
 */
export function withFlatLabels(corners, labels, n) {
    const index = new Uint32Array(corners.length);
    const standsFor = new Int32Array(n).fill(-1);
    const doubled = [];
    const doubledLabels = [];
    const copies = new Map();
    const copyOf = (v, label) => {
        const key = v + n * label;
        if (!copies.has(key)) {
            copies.set(key, n + doubled.length);
            doubled.push(v);
            doubledLabels.push(label);
        }
        return copies.get(key);
    };
    for (let t = 0; t < labels.length; ++t) {
        const label = labels[t];
        let last = -1;
        for (let k = 0; k < 3 && last < 0; ++k)
            if (standsFor[corners[3 * t + k]] === label)
                last = k;
        for (let k = 0; k < 3 && last < 0; ++k)
            if (standsFor[corners[3 * t + k]] < 0) {
                standsFor[corners[3 * t + k]] = label;
                last = k;
            }
        const vertex = last < 0 ? copyOf(corners[3 * t + 2], label) : corners[3 * t + last];
        const turn = last < 0 ? 2 : last;
        index[3 * t] = corners[3 * t + ((turn + 1) % 3)];
        index[3 * t + 1] = corners[3 * t + ((turn + 2) % 3)];
        index[3 * t + 2] = vertex;
    }
    const allLabels = new Uint32Array(n + doubled.length);
    for (let v = 0; v < n; ++v)
        allLabels[v] = Math.max(standsFor[v], 0);
    allLabels.set(doubledLabels, n);
    return { index, doubled: Uint32Array.from(doubled), labels: allLabels };
}

/**
 * Doubles the vertices whose corners differ in a code.
 * @param corners three vertices per triangle, of n. @param codes one per corner.
 * @returns corners of the doubled vertices; vertexOf: of each of these the one it is a copy of, the first n themselves;
 *     codes: one for each.
 */
export function withCodes(corners, codes, n) {
    const vertexOf = Array.from({ length: n }, (_, v) => v);
    const ofVertex = new Float64Array(n).fill(-1);
    const further = [];
    const next = new Map();
    const result = corners.map((v, k) => {
        let own = v;
        for (;;) {
            const code = own < n ? ofVertex[own] : further[own - n];
            if (code === codes[k])
                return own;
            if (code < 0) {
                ofVertex[own] = codes[k];
                return own;
            }
            if (!next.has(own)) {
                next.set(own, vertexOf.length);
                vertexOf.push(v);
                further.push(codes[k]);
            }
            own = next.get(own);
        }
    });
    return { corners: result, vertexOf: Uint32Array.from(vertexOf), codes: [...ofVertex.map((code) => Math.max(code, 0)), ...further] };
}

/**
 * The triangles as they are drawn.
 * @param groups of corners, see creases. @param labels one per triangle. @param places of corners in an image, or null.
 * @returns index: three vertices per triangle; vertexOf, smoothOf, placeOf: the vertex of the mesh, that of smooth
 *     shading, and the place in an image which each of them is; labels: of each; smooth: corners and vertexOf of the
 *     vertices of smooth shading.
 */
export function drawableTriangles(corners, groups, labels, n, places = null) {
    const smooth = withCodes(corners, groups, n);
    const inImage = places === null ? null : withCodes(smooth.corners, places, smooth.vertexOf.length);
    const before = inImage ?? { corners: smooth.corners, vertexOf: smooth.vertexOf.map((_, v) => v) };
    const flat = withFlatLabels(before.corners, labels, before.vertexOf.length);
    const copyOf = Uint32Array.from({ length: flat.labels.length }, (_, v) => (v < before.vertexOf.length ? v : flat.doubled[v - before.vertexOf.length]));
    const smoothOf = copyOf.map((v) => before.vertexOf[v]);
    return {
        index: flat.index,
        labels: flat.labels,
        smoothOf,
        vertexOf: smoothOf.map((v) => smooth.vertexOf[v]),
        placeOf: inImage && copyOf.map((v) => inImage.codes[v]),
        smooth,
    };
}

/**
 * Puts triangles of one material behind one another.
 * @param materials one per triangle. @returns order: the triangles; groups: for each material its begin and its end.
 */
export function byMaterial(materials, count) {
    const ends = new Uint32Array(count + 1);
    for (const material of materials)
        ++ends[material + 1];
    for (let k = 0; k < count; ++k)
        ends[k + 1] += ends[k];
    const next = ends.slice();
    const order = new Uint32Array(materials.length);
    materials.forEach((material, t) => (order[next[material]++] = t));
    return { order, groups: Array.from({ length: count }, (_, k) => [ends[k], ends[k + 1]]) };
}

/** Numbers, so many per triangle, in another order of the triangles. */
export const inOrder = (numbers, order, stride) => numbers.map((_, k) => numbers[stride * order[Math.floor(k / stride)] + (k % stride)]);

/** The edges of the mesh, two vertices each. @param bits one per triangle, bit k: its side from corner k is one. */
export function edgesOf(corners, bits) {
    let count = 0;
    for (const sides of bits)
        count += (sides & 1) + ((sides >> 1) & 1) + ((sides >> 2) & 1);
    const index = new Uint32Array(2 * count);
    for (let t = 0, place = 0; t < bits.length; ++t)
        for (let k = 0; k < 3; ++k)
            if ((bits[t] >> k) & 1) {
                index[place++] = corners[3 * t + k];
                index[place++] = corners[3 * t + ((k + 1) % 3)];
            }
    return index;
}

/** The third of every four coordinates, as View takes values: two numbers each, the first one as packed roots are. */
export function heightsOf(positions) {
    const heights = new Uint16Array(positions.length / 2);
    for (let v = 0; v < heights.length / 2; ++v)
        heights[2 * v] = Math.round(65534 * Math.sqrt(positions[4 * v + 2] / 65535));
    return heights;
}
