import { PageError } from "./parts";

/** A picture as it is stored, without a change of its colours. */
export async function decodedImage(bytes: Uint8Array, type: string): Promise<ImageBitmap> {
  try {
    return await createImageBitmap(new Blob([bytes as BlobPart], { type }), { colorSpaceConversion: "none", premultiplyAlpha: "none" });
  } catch {
    throw new PageError("A picture of this page is damaged. Please load or copy the page again.");
  }
}
