// A row of colours to pick with one press. Called by main.

const COLOURS = [
  ["#ffb35c", "candle"],
  ["#fff1dc", "white"],
  ["#ff4d4d", "red"],
  ["#ff5fc4", "pink"],
  ["#8f7bff", "violet"],
  ["#4db8ff", "blue"],
  ["#3fe0a0", "green"],
];

export function bindSwatches(room, settings) {
  const buttons = COLOURS.map(([colour, name]) => {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", title: name });
    button.setAttribute("aria-label", name);
    button.style.background = colour;
    button.addEventListener("click", () => settings.set("colour", colour));
    return { button, colour };
  });
  room.replaceChildren(...buttons.map(({ button }) => button));
  const refresh = () => {
    for (const { button, colour } of buttons)
      button.setAttribute("aria-pressed", String(colour === settings.get("colour")));
  };
  settings.addEventListener("change", refresh);
  refresh();
}
