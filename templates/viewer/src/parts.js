/** From paths of elements, as findings have them, to parts of the robot. */

/** What of a link stands for it: its looks, else what it bumps with, else whatever there is. */
const BODY = ["visual", "collision"];

/**
 * @typedef {object} Part
 * @property {string} element
 * @property {string} name
 * @property {import("./model.js").Item[]} items
 */

export class Parts {
  /** @param {import("./model.js").Model} model */
  constructor({ links, items }) {
    /** @type {Map<string, Part>} */
    this.byElement = new Map();
    for (const { element, name, items: own } of links) {
      this.#enter(element, name, bodyOf(own));
      for (const item of own) this.#enter(item.element, nameOf(item, name), [item]);
    }
    for (const item of items) this.#enter(item.element, item.name, [item]);
    const whole = links.map(({ element }) => element.slice(0, element.lastIndexOf("/")));
    this.whole = new Set(whole);
  }

  /**
   * Return the part that an element belongs to: the longest prefix of its path that is a part's.
   * What stands for the whole robot (its centre of mass) answers to its own path alone: a plugin
   * has no place there.
   *
   * @param {string} path
   * @returns {Part | undefined}
   */
  find(path) {
    for (let end = path.length; end > 0; end = path.lastIndexOf("/", end - 1)) {
      const part = this.byElement.get(path.slice(0, end));
      if (part) return end < path.length && this.whole.has(part.element) ? undefined : part;
    }
    return undefined;
  }

  /** @type {(element: string, name: string, items: import("./model.js").Item[]) => void} */
  #enter(element, name, items) {
    if (!element) return;
    const known = this.byElement.get(element);
    if (known) known.items = [...new Set([...known.items, ...items])];
    else this.byElement.set(element, { element, name, items: [...items] });
  }
}

/** @type {(items: import("./model.js").Item[]) => import("./model.js").Item[]} */
function bodyOf(items) {
  for (const layer of BODY) {
    const body = items.filter((item) => item.layer === layer);
    if (body.length) return body;
  }
  return items;
}

/**
 * What is one of its kind in a link, such as its inertial, is named with the link.
 *
 * @type {(item: import("./model.js").Item, link: string) => string}
 */
const nameOf = ({ element, name }, link) => (element.endsWith("]") ? name : `${link} ${name}`);
