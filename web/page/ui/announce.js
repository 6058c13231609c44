// Messages: a line for everyone, read out by screen readers, and a box for what must not be missed. Called by
// everything that has something to say.

export class Messages {
  #status;
  #notice;
  #noticeText;
  #spoken = 0;

  constructor(root) {
    this.#status = root.querySelector("#status");
    this.#notice = root.querySelector("#notice");
    this.#noticeText = root.querySelector("#notice-text");
    root.querySelector("#notice-close").addEventListener("click", () => this.clear());
  }

  /** One line, politely. */
  say(text) {
    this.#status.textContent = text;
  }

  /** The same for what changes many times a second: the last of it, at most every third of a second. */
  sayLater(text) {
    clearTimeout(this.#spoken);
    this.#spoken = setTimeout(() => this.say(text), 300);
  }

  /** Something that stays until it is closed. */
  notice(text) {
    this.#noticeText.textContent = text;
    this.#notice.hidden = false;
  }

  clear() {
    this.#notice.hidden = true;
  }
}
