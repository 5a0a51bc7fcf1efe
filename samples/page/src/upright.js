// Which way up a mesh is meant to stand.

/** The axis that files of a format have upwards by habit: y in those of modellers, z in those of scanners and printers. */
const habit = (name) => (/\.(obj|gltf|glb)(\.gz)?$/i.test(name) ? 1 : 2);

/**
 * @returns parts: for each axis the area of what is flat across it at its lower and at its upper end, as parts of that
 *     side of the box; mean: the mean of all normals, by area, which is 0 if the surface is closed.
 * @param points, sizes see guessUp. @param corners three vertices per triangle.
 */
function measured(points, sizes, corners) {
    const largest = Math.max(...sizes) * 65535;
    const tolerance = 0.012 * largest;
    const areas = [[0, 0], [0, 0], [0, 0]];
    const sum = [0, 0, 0];
    let whole = 0;
    const place = (corner, axis) => sizes[axis] * points[4 * corners[corner] + axis];
    // Of many triangles a part tells as much.
    const stride = Math.ceil(corners.length / 3 / 300000) || 1;
    for (let t = 0; t < corners.length; t += 3 * stride) {
        const [u, w] = [t + 1, t + 2].map((corner) => [0, 1, 2].map((axis) => place(corner, axis) - place(t, axis)));
        const normal = [0, 1, 2].map((k) => u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3]);
        const area = 0.5 * Math.hypot(...normal) * stride;
        normal.forEach((part, k) => (sum[k] += 0.5 * part * stride));
        whole += area;
        const axis = normal.findIndex((part) => Math.abs(part) > (2 * 0.96 * area) / stride);
        if (axis < 0)
            continue;
        const height = place(t, axis);
        if (height <= tolerance)
            areas[axis][0] += area;
        if (65535 * sizes[axis] - height <= tolerance)
            areas[axis][1] += area;
    }
    return {
        parts: areas.map((pair, axis) => pair.map((area) => area / (sizes[(axis + 1) % 3] * sizes[(axis + 2) % 3] * 65535 ** 2 || 1))),
        mean: sum.map((part) => part / (whole || 1)),
    };
}

/**
 * Guesses the direction upwards: that in which the faces of a height field look; else away from the end of the box that
 * has the largest flat extent, if any has one worth standing on; else across what is much wider than high, and where no
 * habit tells, along what is much longer than wide; else by habit, which decides, too, where flat extents are about as
 * large.
 *
 * @param points four numbers of 16 bits for each vertex, from 0 to 65535 within the box. @param extent of the box.
 * @param corners three vertices per triangle. @param name of the file.
 * @returns axis from 0 to 2 and sign.
 */
export function guessUp(points, extent, corners, name) {
    const order = [0, 1, 2].sort((a, b) => extent[a] - extent[b]);
    const [thin, middle, long] = order.map((axis) => extent[axis]);
    const preferred = habit(name);
    const sizes = extent.map((size) => size / 65535 / (long || 1));
    // A flat top is as good a side as a flat base; few meshes stand on their heads.
    const { parts: ends, mean } = measured(points, sizes, corners);
    const alike = mean.map(Math.abs);
    if (Math.max(...alike) > 0.55)
        return { axis: alike.indexOf(Math.max(...alike)), sign: 1 };
    const sides = ends.flatMap((parts, axis) =>
        parts.map((part, end) => ({ axis, sign: end === 0 ? 1 : -1, score: part * (axis === preferred ? 1.6 : 1) * (end === 0 ? 1 : 0.3) })),
    );
    const best = sides.reduce((one, other) => (other.score > one.score ? other : one));
    if (best.score > 0.045)
        return { axis: best.axis, sign: best.sign };
    if (thin < 0.5 * middle)
        return { axis: order[0], sign: 1 };
    return { axis: preferred === 2 && long > 1.6 * middle ? order[2] : preferred, sign: 1 };
}
