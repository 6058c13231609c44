// Colours between what people pick (#rrggbb, sRGB) and what light is counted in (linear RGB). Called by
// materials, scenes, files and views.

/** One sRGB channel, 0 .. 1, to linear. */
function toLinear(channel) {
  return channel <= 0.04045 ? channel / 12.92 : ((channel + 0.055) / 1.055) ** 2.4;
}

/** One linear channel to sRGB, 0 .. 1; more than 1 is cut. */
export function toDisplay(channel) {
  const cut = Math.min(Math.max(channel, 0), 1);
  return cut <= 0.0031308 ? cut * 12.92 : 1.055 * cut ** (1 / 2.4) - 0.055;
}

/** "#rrggbb" to linear RGB. */
export function linearOfHex(hex) {
  return [1, 3, 5].map((at) => toLinear(parseInt(hex.slice(at, at + 2), 16) / 255));
}

/** Linear RGB to "#rrggbb". */
export function hexOfLinear(rgb) {
  return (
    "#" +
    rgb
      .map((c) =>
        Math.round(toDisplay(c) * 255)
          .toString(16)
          .padStart(2, "0"),
      )
      .join("")
  );
}

/** Linear values of the 256 sRGB bytes. */
export const LINEAR_OF_BYTE = Float32Array.from({ length: 256 }, (_, byte) => toLinear(byte / 255));
