// Normals for smooth shading, and where they must not be smooth.

/** The normal of every triangle, twice its area long. @param sizes of a unit of the points, along each axis. */
function triangleNormals(corners, points, sizes) {
    const normals = new Float32Array(corners.length);
    const [sx, sy, sz] = sizes;
    for (let t = 0; t < corners.length; t += 3) {
        const [a, b, c] = [4 * corners[t], 4 * corners[t + 1], 4 * corners[t + 2]];
        const [ux, uy, uz] = [sx * (points[b] - points[a]), sy * (points[b + 1] - points[a + 1]), sz * (points[b + 2] - points[a + 2])];
        const [wx, wy, wz] = [sx * (points[c] - points[a]), sy * (points[c + 1] - points[a + 1]), sz * (points[c + 2] - points[a + 2])];
        normals[t] = uy * wz - uz * wy;
        normals[t + 1] = uz * wx - ux * wz;
        normals[t + 2] = ux * wy - uy * wx;
    }
    return normals;
}

/** Scales each three numbers to length 1; zeros stay. */
function normalise(vectors) {
    for (let k = 0; k < vectors.length; k += 3) {
        const length = Math.hypot(vectors[k], vectors[k + 1], vectors[k + 2]) || 1;
        for (let c = 0; c < 3; ++c)
            vectors[k + c] /= length;
    }
    return vectors;
}

/** The sum of the triangles' normals around each of n vertices. */
function sums(corners, normals, n) {
    const result = new Float32Array(3 * n);
    for (let k = 0; k < corners.length; ++k) {
        const [to, from] = [3 * corners[k], k - (k % 3)];
        result[to] += normals[from];
        result[to + 1] += normals[from + 1];
        result[to + 2] += normals[from + 2];
    }
    return result;
}

/** Parts a unit's box into sizes, so that lengths along all axes are in one unit. */
export const sizesOf = ({ lower, upper }) => {
    const extent = lower.map((x, k) => upper[k] - x);
    const largest = Math.max(...extent) || 1;
    return extent.map((size) => size / largest);
};

/**
 * Area-weighted normals of n vertices, four numbers of 16 bits each.
 * @param corners of triangles. @param vertexOf the vertex whose place each of the n has. @param points four numbers each.
 */
export function vertexNormals(corners, vertexOf, points, sizes) {
    const n = vertexOf.length;
    const normals = normalise(sums(corners, triangleNormals(corners.map((v) => vertexOf[v]), points, sizes), n));
    const result = new Int16Array(4 * n);
    for (let v = 0; v < n; ++v)
        for (let c = 0; c < 3; ++c)
            result[4 * v + c] = Math.round(32767 * normals[3 * v + c]);
    return result;
}

const cosOfCrease = Math.cos((40 * Math.PI) / 180);
const cosOfHalf = Math.cos((18 * Math.PI) / 180);

/** Numbers the corners of one vertex: those that triangles join, and no crease parts, get one number. */
function numberFans(corners, fan, normals, groups) {
    const joined = fan.map((_, k) => k);
    const root = (k) => (joined[k] === k ? k : (joined[k] = root(joined[k])));
    const others = fan.map((k) => [k - (k % 3) + ((k + 1) % 3), k - (k % 3) + ((k + 2) % 3)].map((other) => corners[other]));
    const dot = (a, b) => [0, 1, 2].reduce((sum, c) => sum + normals[a - (a % 3) + c] * normals[b - (b % 3) + c], 0);
    for (let a = 0; a < fan.length; ++a)
        for (let b = 0; b < a; ++b)
            if (others[a].some((v) => others[b].includes(v)) && dot(fan[a], fan[b]) >= cosOfCrease)
                joined[root(a)] = root(b);
    const numbers = new Map();
    fan.forEach((corner, k) => {
        if (!numbers.has(root(k)))
            numbers.set(root(k), numbers.size);
        groups[corner] = numbers.get(root(k));
    });
    return numbers.size;
}

/**
 * Parts the corners around each vertex at creases, which are sharper than 40°.
 * @returns groups: of each corner, numbered from 0 around its vertex; share: the part of the vertices that have several.
 */
export function creases(corners, points, sizes, n) {
    const normals = normalise(triangleNormals(corners, points, sizes));
    const means = normalise(sums(corners, normals, n));
    const fans = new Map();
    for (let k = 0; k < corners.length; ++k) {
        const [mean, own] = [3 * corners[k], k - (k % 3)];
        if (means[mean] * normals[own] + means[mean + 1] * normals[own + 1] + means[mean + 2] * normals[own + 2] < cosOfHalf)
            fans.set(corners[k], []);
    }
    corners.forEach((v, k) => fans.get(v)?.push(k));
    const groups = new Uint16Array(corners.length);
    let parted = 0;
    for (const fan of fans.values())
        parted += numberFans(corners, fan, normals, groups) > 1 ? 1 : 0;
    return { groups, share: parted / (n || 1) };
}
