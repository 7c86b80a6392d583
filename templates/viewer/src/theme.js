/** Colours of the two themes. The accent is one that robots and layers rarely have. */

/**
 * @typedef {object} Theme
 * @property {number} background
 * @property {number} grid
 * @property {number} sky Light from above.
 * @property {number} earth Light from below.
 * @property {number} shadow Opacity of shadows.
 * @property {number} accent Of what is selected.
 * @property {number} trail Of the robot's path.
 * @property {string} ink Of labels, as CSS.
 * @property {string} paper Behind labels, as CSS.
 */

/** @type {Record<"light" | "dark", Theme>} */
export const THEMES = {
  light: {
    background: 0xeef1f5,
    grid: 0x3d4856,
    sky: 0xffffff,
    earth: 0xaab0ba,
    shadow: 0.22,
    accent: 0xe0006f,
    trail: 0x0b5cad,
    ink: "#1b1f24",
    paper: "rgba(255, 255, 255, 0.9)",
  },
  dark: {
    background: 0x2b313a,
    grid: 0xc3cedd,
    sky: 0xffffff,
    earth: 0x59626f,
    shadow: 0.45,
    accent: 0xff4da6,
    trail: 0x7ab8ff,
    ink: "#e6e9ee",
    paper: "rgba(15, 18, 22, 0.88)",
  },
};

/**
 * @param {string} name
 * @returns {Theme} The light one, where there is none of this name.
 */
export const themeOf = (name) => THEMES[name === "dark" ? "dark" : "light"];
