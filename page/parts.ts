// The bytes of a picture: blocks of base64 text in the page, deflated but for pictures and films.

import { Facts } from "./manifest";

/** Where the bytes of a picture come from. */
export interface Source {
  facts: Facts;
  /** Of the page that it stands in: what lies beside the page is named from there. */
  address: string;
  /** The bytes of a part as they stand in the page. Throws where they are missing or cut off. */
  bytes(name: string): Promise<Uint8Array>;
}

/** A page that cannot be shown, said in a sentence, and what there is to see in its place besides the still picture. */
export class PageError extends Error {
  constructor(
    sentence: string,
    readonly instead?: HTMLElement,
  ) {
    super(sentence);
  }
}

const incomplete = "The data of this picture is incomplete. Please load or copy the page again.";

function decodedBase64(text: string): Uint8Array {
  let binary: string;
  try {
    binary = atob(text.trim());
  } catch {
    throw new PageError(incomplete);
  }
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** A zlib stream ends with a checksum, so that what is cut off or damaged is found out. */
export async function inflated(bytes: Uint8Array): Promise<ArrayBuffer> {
  try {
    const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream("deflate"));
    return await new Response(stream).arrayBuffer();
  } catch {
    throw new PageError(incomplete);
  }
}

/** The element with the facts, and behind it those with the parts, in a document that may still be loading. */
export async function sourceIn(root: Document, id: string, address: string): Promise<Source> {
  // An element is whole once another one follows it, or all is loaded.
  const whole = async (selector: string): Promise<string> => {
    for (;;) {
      const loaded = root.readyState !== "loading";
      const element = root.querySelector(selector);
      if (element && (loaded || element.nextElementSibling)) return element.textContent ?? "";
      if (loaded) throw new PageError(incomplete);
      await new Promise((wait) => setTimeout(wait, 20));
    }
  };
  let facts: Facts;
  try {
    facts = JSON.parse(await whole(`#${CSS.escape(id)}`)) as Facts;
  } catch {
    throw new PageError(incomplete);
  }
  return {
    facts,
    address,
    bytes: async (name) => {
      const [type, length, text] = (await whole(`[data-part="${CSS.escape(id)}/${CSS.escape(name)}"]`)).split(":");
      const bytes = decodedBase64(text ?? "");
      if (type !== "base64" || bytes.length !== Number(length)) throw new PageError(incomplete);
      return bytes;
    },
  };
}

/** The picture that an address tells: "#id" in this document, or else a page that `wheatstone share` wrote. */
export async function sourceAt(address: string, document: Document): Promise<Source> {
  if (address.startsWith("#")) return sourceIn(document, address.slice(1), document.baseURI);
  const answer = await fetch(address);
  if (!answer.ok) throw new PageError(`The picture ${address} cannot be loaded (${answer.status}).`);
  return sourceIn(new DOMParser().parseFromString(await answer.text(), "text/html"), "picture", answer.url);
}

/** Numbers as the part's streams of bytes hold them: seven bits a byte, the lowest first. */
export class NumberStream {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}

  whole(): number {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      const byte = this.bytes[this.at++];
      if (byte === undefined) throw new PageError(incomplete);
      value += (byte & 127) * scale;
      if (byte < 128) return value;
    }
  }

  /** Of either sign: 0, -1, 1, -2, … */
  signed(): number {
    const code = this.whole();
    return code % 2 === 0 ? code / 2 : -(code + 1) / 2;
  }

  get ended(): boolean {
    return this.at >= this.bytes.length;
  }
}

/** A part that holds several streams: how many, the length of each, and then their bytes. */
export async function streamsOf(source: Source, name: string): Promise<NumberStream[]> {
  const bytes = new Uint8Array(await inflated(await source.bytes(name)));
  const head = new DataView(bytes.buffer);
  const count = head.getUint32(0, true);
  const streams: NumberStream[] = [];
  let begin = 4 + 4 * count;
  for (let i = 0; i < count; ++i) {
    const end = begin + head.getUint32(4 + 4 * i, true);
    streams.push(new NumberStream(bytes.subarray(begin, end)));
    begin = end;
  }
  return streams;
}
