// Shapes as sets of pixels: bounds, and a test of one pixel's centre. A pixel is covered when its centre lies
// inside or on the edge, as in the library. Called by pen, lantern and scenes.

/** A round dot. */
export function disc(x, y, radius) {
  return {
    bounds: [x - radius, y - radius, x + radius, y + radius],
    covers: (px, py) => (px - x) ** 2 + (py - y) ** 2 <= radius ** 2,
  };
}

/** Everything within `radius` of a line from a to b. */
export function capsule([ax, ay], [bx, by], radius) {
  const dx = bx - ax,
    dy = by - ay,
    length2 = dx * dx + dy * dy;
  return {
    bounds: [
      Math.min(ax, bx) - radius,
      Math.min(ay, by) - radius,
      Math.max(ax, bx) + radius,
      Math.max(ay, by) + radius,
    ],
    covers: (px, py) => {
      const t = length2 > 0 ? Math.min(Math.max(((px - ax) * dx + (py - ay) * dy) / length2, 0), 1) : 0;
      return (px - ax - t * dx) ** 2 + (py - ay - t * dy) ** 2 <= radius ** 2;
    },
  };
}

/** An upright rectangle between two corners. */
export function box([ax, ay], [bx, by]) {
  const [left, right] = [Math.min(ax, bx), Math.max(ax, bx)];
  const [top, bottom] = [Math.min(ay, by), Math.max(ay, by)];
  return {
    bounds: [left, top, right, bottom],
    covers: (px, py) => px >= left && px <= right && py >= top && py <= bottom,
  };
}

/** The outline of an upright rectangle: a line of `width` around its edge. */
export function frame(a, b, width) {
  const grown = (by) => {
    const [left, top, right, bottom] = box(a, b).bounds;
    return left - by > right + by || top - by > bottom + by
      ? null
      : box([left - by, top - by], [right + by, bottom + by]);
  };
  const outer = grown(width / 2),
    inner = grown(-width / 2);
  return {
    bounds: outer.bounds,
    covers: (px, py) => outer.covers(px, py) && !(inner && inner.covers(px, py)),
  };
}

/** The outline of a disc: a line of `width` around its edge. */
export function ring(x, y, radius, width) {
  const outer = disc(x, y, radius + width / 2),
    inner = Math.max(radius - width / 2, 0);
  return {
    bounds: outer.bounds,
    covers: (px, py) => outer.covers(px, py) && (px - x) ** 2 + (py - y) ** 2 > inner ** 2,
  };
}

/** A polygon by its corners; inside by the even-odd rule. */
export function polygon(corners) {
  const xs = corners.map((c) => c[0]),
    ys = corners.map((c) => c[1]);
  return {
    bounds: [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)],
    covers: (px, py) => {
      let inside = false;
      for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
        const [ax, ay] = corners[i],
          [bx, by] = corners[j];
        if (ay > py !== by > py && px < ax + ((py - ay) / (by - ay)) * (bx - ax)) inside = !inside;
      }
      return inside;
    },
  };
}

/** The pixels that bounds touch, cut to a picture: [left, top, right, bottom], right and bottom not included. */
export function pixelBounds(bounds, width, height) {
  return [
    Math.max(Math.floor(bounds[0]), 0),
    Math.max(Math.floor(bounds[1]), 0),
    Math.min(Math.ceil(bounds[2]) + 1, width),
    Math.min(Math.ceil(bounds[3]) + 1, height),
  ];
}

/** Calls visit(index of the pixel) for each covered pixel of a picture. */
export function forEachPixel(shape, width, height, visit) {
  const [left, top, right, bottom] = pixelBounds(shape.bounds, width, height);
  for (let y = top; y < bottom; y++)
    for (let x = left; x < right; x++) if (shape.covers(x + 0.5, y + 0.5)) visit(y * width + x);
}
