// The colours and textures that the file of the mesh has itself, see samples/page/file_colours.h.

import { facts, unpacked16, unpacked32, unpackedBytes } from "./data.js";
import { byMaterial, labelsOfTriangles } from "./faces.js";

const { colours } = facts.mesh;

export const hasMaterials = colours?.materials !== undefined;
export const hasImages = hasMaterials && colours.materials.some(({ image }) => image !== undefined);
export const hasVertexColours = colours?.vertices !== undefined;

/** Three numbers from 0 to 255 for each vertex. */
export const vertexColours = () => unpackedBytes(colours.vertices);

async function imageIn(block) {
    const image = new Image();
    image.src = document.getElementById(`block-${block}`).textContent;
    await image.decode();
    return image;
}

/** Colour and image of each material; an image that cannot be read is none. */
export const materials = () =>
    Promise.all(colours.materials.map(async ({ colour, image }) => ({ colour, image: image === undefined ? null : await imageIn(image).catch(() => null) })));

/**
 * What triangles need for it: their order and groups, see byMaterial; places of corners, and all places, where there
 * are images.
 */
export async function layout(perFace, nTriangles) {
    const ofFaces = await unpacked32(colours.material_of_face, 1);
    const result = byMaterial(labelsOfTriangles(ofFaces, perFace, nTriangles), colours.materials.length);
    if (colours.places === undefined)
        return { ...result, placeOfCorner: null, places: null };
    const [placeOfCorner, places] = await Promise.all([unpacked32(colours.place_of_corner, 3), unpacked16(colours.places.block, 3, 4)]);
    return { ...result, placeOfCorner, places };
}
