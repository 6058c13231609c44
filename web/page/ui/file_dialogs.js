// The dialogs to open and save pictures, and dropping a file on the page. Called by main.
import { drawingImage, savePng, worldOfFile } from "./files.js";

/** A name that savePng() gave says how bright its lamps were. */
function brightnessOfName(name) {
  const found = /-x(\d+(?:\.\d+)?)\.png$/.exec(name);
  return found ? Number(found[1]) : 1;
}

export function bindFiles(root, drawing, messages) {
  const find = (id) => root.querySelector(`#${id}`);
  const input = find("file"),
    dialog = find("open-dialog");
  let file = null;

  const choose = (given) => {
    file = given;
    find("open-name").textContent = file.name;
    find("open-brightness").value = brightnessOfName(file.name);
    dialog.showModal();
  };
  const read = async () => {
    const reading = dialog.querySelector("input[name=reading]:checked").value;
    try {
      const world = await worldOfFile(file, reading, Number(find("open-brightness").value), drawing.world);
      drawing.replace(world, "opening a picture", true);
      messages.say(`${file.name} is open.`);
    } catch (error) {
      messages.notice(`${file.name} could not be read as a picture (${error.message}).`);
    }
  };

  find("open").addEventListener("click", () => input.click());
  input.addEventListener("change", () => {
    if (input.files.length > 0) choose(input.files[0]);
    input.value = "";
  });
  find("open-cancel").addEventListener("click", () => dialog.close());
  dialog.querySelector("form").addEventListener("submit", read);
  root.addEventListener("dragover", (event) => event.preventDefault());
  root.addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer.files.length > 0) choose(event.dataTransfer.files[0]);
  });

  find("save").addEventListener("click", () => find("save-dialog").showModal());
  find("save-view").addEventListener("click", () => savePng(find("picture"), "dapple.png"));
  find("save-world").addEventListener("click", () => {
    const { image, brightness } = drawingImage(drawing.world);
    savePng(image, `dapple-drawing-x${Number(brightness.toFixed(3))}.png`);
    messages.say(`Saved. Its lamps are ${brightness.toFixed(1)} times as bright as the file's colours say.`);
  });
}
