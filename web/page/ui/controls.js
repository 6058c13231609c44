// Ties the form to the settings: every element with data-setting shows and sets the setting of that name, and
// every element with data-when is there only while its settings fit. Called by main.

function show(element, value) {
  if (element.type === "radio") element.checked = element.value === String(value);
  else if (element.type === "checkbox") element.checked = value;
  else element.value = String(value);
}

function valueOf(element) {
  return element.type === "checkbox" ? element.checked : element.value;
}

/** A half-typed number is not to be overwritten. */
function isBeingTyped(element) {
  return element.type === "number" && element === document.activeElement;
}

/** "solver=cascades skip=bounded|exact": each word must hold. */
function holds(condition, settings) {
  return condition.split(" ").every((word) => {
    const [name, values] = word.split("=");
    return values.split("|").includes(String(settings.get(name)));
  });
}

/** How sliders print their value beside them. */
const PRINT = {
  radius: (value) => `${value} px`,
  brightness: (value) => `${Number(value).toFixed(1)}`,
  density: (value) => `${Number(value).toFixed(1)}`,
  exposure: (value) => `${value > 0 ? "+" : ""}${Number(value).toFixed(1)} EV`,
  range: (value) => `${value} cells`,
  bound: (value) => `${value} dB`,
};

export function bindControls(root, settings) {
  const elements = [...root.querySelectorAll("[data-setting]")];
  const outputs = [...root.querySelectorAll("[data-value-of]")];
  const conditional = [...root.querySelectorAll("[data-when]")];

  const refresh = () => {
    for (const element of elements) if (!isBeingTyped(element)) show(element, settings.get(element.dataset.setting));
    for (const output of outputs) {
      const name = output.dataset.valueOf;
      output.textContent = PRINT[name](settings.get(name));
    }
    for (const element of conditional) element.hidden = !holds(element.dataset.when, settings);
  };
  for (const element of elements) {
    element.addEventListener("input", () => settings.set(element.dataset.setting, valueOf(element)));
    element.addEventListener("change", () => show(element, settings.get(element.dataset.setting)));
  }
  settings.addEventListener("change", refresh);
  refresh();
}
