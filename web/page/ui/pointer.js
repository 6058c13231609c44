// Mouse, pen and touch on the picture. Called by main.

/** Where an event points at, in pixels of the picture. */
function placeOf(event, canvas) {
  const box = canvas.getBoundingClientRect();
  return [
    ((event.clientX - box.left) / box.width) * canvas.width,
    ((event.clientY - box.top) / box.height) * canvas.height,
  ];
}

export function bindPointer(canvas, pen) {
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !event.isPrimary) return;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    pen.down(placeOf(event, canvas));
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!event.isPrimary) return;
    // A fast hand draws several points a frame: all of them count while drawing.
    const events = pen.isDown && event.getCoalescedEvents ? event.getCoalescedEvents() : [event];
    for (const each of events.length ? events : [event]) pen.move(placeOf(each, canvas));
  });
  canvas.addEventListener("pointerup", () => pen.up());
  canvas.addEventListener("pointercancel", () => pen.cancel());
  canvas.addEventListener("pointerleave", () => pen.leave());
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
}
