import { Surfaces } from "./surfaces";

/** The disparity at a place of any view: what the reference view sees there, once it is moved there. */
export function disparityInView(surfaces: Surfaces | undefined, x: number, y: number, view: number): number | undefined {
  if (!surfaces || surfaces.isEmpty) return undefined;
  const [reference] = surfaces.facts;
  let found: number | undefined;
  for (let column = 0; column < reference!.width; ++column) {
    const d = surfaces.disparityAt(column, y);
    if (d === undefined) continue;
    const seen = reference!.left + column + 0.5 - (view - reference!.view) * d;
    if (Math.abs(seen - x) <= 1 && (found === undefined || d > found)) found = d;
  }
  return found;
}
