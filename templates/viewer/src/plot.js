/** Curves of a trial over time, drawn by uPlot: legs behind them, values where one points. */

import uPlot from "uplot";
import sheet from "uplot/dist/uPlot.min.css";

const HUES = ["#2f7fd6", "#c2570c", "#2f8f5b", "#9a4fb5", "#a88b00", "#c9356b", "#3d8b99", "#8a7763"];
const DASHES = { command: [6, 4], limit: [2, 3] };
const HEIGHT = 190; // CSS pixels of the drawing, the legend aside
const LEGS = 16; // CSS pixels above it for the names of the legs
const TICKS = 10; // CSS pixels of letters
const FINEST = 1e-4; // of the axis: what is less is noise

/**
 * @typedef {{name: string, kind: "measured" | "command" | "limit", hue: number,
 *   values: (number | null)[]}} Curve
 * @typedef {{title: string, unit: string, low: number, high: number, curves: Curve[]}} Plot
 * @typedef {{name: string, start: number, end: number}} Leg
 */

/**
 * Draw a plot.
 *
 * @param {HTMLElement} host What it fills; its width is the page's affair.
 * @param {Plot} data
 * @param {{time: number[], legs: Leg[]}} course
 * @param {{group: string, seek: (time: number) => void, leave: () => void}} ties `group`: plots of
 *   one name show one moment; `seek` is called for a press, `leave` when the pointer goes.
 * @returns {{show: (time: number) => void, repaint: () => void}}
 */
export function plot(host, data, { time, legs }, { group, seek, leave }) {
  addSheet();
  const paint = colours(host);
  const drawn = joined(data.curves);
  const end = legs.at(-1)?.end ?? time.at(-1) ?? 1;
  let shown = 0;
  const figure = new uPlot(
    {
      width: host.clientWidth,
      height: HEIGHT,
      cursor: { drag: { x: false, y: false }, y: false, sync: { key: group, setSeries: false } },
      scales: { x: { time: false, range: [0, end] }, y: { range: [data.low, data.high] } },
      padding: [LEGS, null, null, null],
      axes: [axis(paint, (value) => `${value} s`, 28), axis(paint, String, 52)],
      series: [
        { label: "time", value: (_, value) => (value == null ? "–" : `${value.toFixed(2)} s`) },
        ...drawn.map((curve) => series(curve, data, paint)),
      ],
      hooks: { drawClear: [(self) => drawLegs(self, legs, paint)], ready: [() => show(shown)] },
    },
    [time, ...drawn.map(({ values }) => [...values, ...Array(time.length).fill(null)].slice(0, time.length))],
    host,
  );
  describe(figure, data);
  tellOnce(figure, drawn);
  const show = (moment) => {
    shown = moment;
    // Before it is ready it knows no positions, and would tell of another moment.
    if (figure.status === 1) figure.setCursor({ left: figure.valToPos(moment, "x"), top: 0 }, false);
  };
  listen(figure, seek, leave);
  new ResizeObserver(() => {
    if (host.clientWidth) figure.setSize({ width: host.clientWidth, height: HEIGHT });
    show(shown);
  }).observe(host);
  return { show, repaint: () => figure.redraw(false) };
}

/**
 * Limits of one name that are never there at one time are one curve; the others stay apart.
 *
 * @param {Curve[]} curves
 * @returns {Curve[]}
 */
function joined(curves) {
  /** @type {Curve[]} */
  const result = [];
  for (const curve of curves) {
    const same = result.find((other) => curve.kind === "limit" && other.kind === "limit" &&
      other.name === curve.name && other.values.every((value, i) => value == null || curve.values[i] == null));
    if (same) same.values = same.values.map((value, i) => value ?? curve.values[i]);
    else result.push({ ...curve });
  }
  return result;
}

function series({ name, kind, hue }, { unit, low, high }, paint) {
  const told = (value) => (Math.abs(value) < FINEST * (high - low) ? 0 : +value.toPrecision(3));
  return {
    label: name,
    width: kind === "measured" ? 1.75 : 1.5,
    stroke: () => (kind === "measured" ? HUES[hue % HUES.length] : paint(kind === "limit" ? "--error" : "--ink")),
    dash: DASHES[kind],
    points: { show: false },
    value: (_, value) => (value == null ? "–" : `${told(value)} ${unit}`),
  };
}

function axis(paint, words, size) {
  return {
    size,
    font: `${TICKS + 1}px system-ui, sans-serif`,
    stroke: () => paint("--faded"),
    grid: { stroke: () => paint("--line"), width: 1 },
    ticks: { stroke: () => paint("--line"), width: 1 },
    values: (_, splits) => splits.map((value) => words(+value.toPrecision(6))),
  };
}

/** Shade every other leg, and write the name of each where there is room. */
function drawLegs(figure, legs, paint) {
  const { ctx, bbox } = figure;
  const finer = devicePixelRatio;
  ctx.save();
  ctx.font = `${TICKS * finer}px system-ui, sans-serif`;
  ctx.textBaseline = "top";
  legs.forEach(({ name, start, end }, number) => {
    const left = figure.valToPos(start, "x", true);
    const width = figure.valToPos(end, "x", true) - left;
    if (number % 2) {
      ctx.fillStyle = paint("--ground");
      ctx.fillRect(left, bbox.top - LEGS * finer, width, bbox.height + LEGS * finer);
    }
    ctx.fillStyle = paint("--faded");
    const words = fitting(ctx, name, width - 8 * finer);
    ctx.fillText(words, left + 4 * finer, bbox.top - (LEGS - 3) * finer);
  });
  ctx.restore();
}

function fitting(ctx, name, width) {
  if (ctx.measureText(name).width <= width) return name;
  let length = name.length - 1;
  while (length > 2 && ctx.measureText(`${name.slice(0, length)}…`).width > width) length -= 1;
  return length > 2 ? `${name.slice(0, length).trim()}…` : "";
}

/** @type {(host: HTMLElement) => (name: string) => string} */
function colours(host) {
  return (name) => getComputedStyle(host).getPropertyValue(name).trim() || "#888888";
}

/** Tell those who do not see it what is drawn; the table has the figures. */
function describe(figure, { title, unit }) {
  figure.ctx.canvas.setAttribute("role", "img");
  figure.ctx.canvas.setAttribute("aria-label", `${title} in ${unit} over time`);
}

/** A limit on both sides of zero is one line of the legend. */
function tellOnce({ root }, drawn) {
  const rows = root.querySelectorAll(".u-legend .u-series");
  drawn.forEach(({ name, kind }, index) => {
    const first = drawn.findIndex((other) => other.name === name && other.kind === kind);
    if (first < index) rows[index + 1].hidden = true;
  });
}

/** A press, and a pull, choose a moment; who leaves the plot sees the chosen one again. */
function listen({ over, posToVal }, choose, leave) {
  const chosen = (event) => {
    const box = over.getBoundingClientRect();
    choose(posToVal(Math.min(Math.max(0, event.clientX - box.left), box.width), "x"));
  };
  over.addEventListener("pointerdown", chosen);
  over.addEventListener("pointermove", (event) => { if (event.buttons & 1) chosen(event); });
  over.addEventListener("mouseleave", () => setTimeout(leave));
}

function addSheet() {
  if (document.getElementById("uplot-sheet")) return;
  const style = document.createElement("style");
  style.id = "uplot-sheet";
  style.textContent = sheet;
  document.head.prepend(style);
}
