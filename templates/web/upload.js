// The form of the start page: drop, choose, pack, send. Without this script it is a plain form.

import { chosen, dropped, Incomplete, megabytes, ofFolder, Refusal } from "./choosing.js";
import { sending } from "./sending.js";
import { zipped } from "./zip.js";

document.documentElement.classList.add("scripted");
const part = (id) => document.getElementById(id);
const form = part("upload");
const limits = {
  bytes: Number(form.dataset.bytes),
  files: Number(form.dataset.files),
  unpacked: Number(form.dataset.unpacked),
  endings: form.dataset.endings.split(" "),
};
let given = null;
let kept = []; // loose files that others are to be added to
let stop = null;

part("file").required = false; // a folder will do as well
part("file").multiple = true;

function refuse(problem) {
  part("refusal").textContent = problem instanceof Refusal
    ? problem.message
    : "The files cannot be read. They may have changed since they were chosen: choose them again.";
}

// Takes what was chosen, or says why not; `find` returns the files, or a promise of them. A model and the files that it
// needs may come one after the other.
async function take(find) {
  const before = kept;
  let files = [];
  given = null;
  kept = [];
  part("refusal").textContent = "";
  part("chosen").textContent = "";
  part("missing").textContent = "";
  try {
    files = await find();
    if (files.every(({ path }) => !path.includes("/"))) {
      files = [...before.filter(({ path }) => !files.some((other) => other.path === path)), ...files];
    }
    given = await chosen(files, limits);
    kept = given.missing.length ? files : [];
    const number = given.file ? "" : `${given.files.length} file${given.files.length === 1 ? "" : "s"}, `;
    part("chosen").textContent = `${given.name}: ${number}${megabytes(given.bytes)}`;
    part("missing").textContent = asking(given.missing);
  } catch (problem) {
    kept = problem instanceof Incomplete ? files : [];
    refuse(problem);
  }
}

function asking(missing) {
  if (missing.length === 0) return "";
  const more = missing.length > 5 ? ` and ${missing.length - 5} more` : "";
  return `The model needs ${missing.slice(0, 5).join(", ")}${more}: drop or choose them too, or its package folder. `
    + "Without them, what depends on them is not checked.";
}

function show(doing, share) {
  const percent = Math.round(100 * share);
  part("bar").value = percent;
  part("doing").textContent = share < 1 ? `${doing}, ${percent} %` : `${doing}, waiting for the answer`;
}

function busy(yes) {
  part("going").hidden = !yes;
  part("check").disabled = yes;
  stop = yes ? stop : null;
}

async function send() {
  busy(true);
  show("Packing", 0);
  part("refusal").textContent = "";
  try {
    const { name, bytes, files, file } = given;
    const archive = file ?? (await zipped(files, (read) => show("Packing", (0.999 * read) / (bytes || 1))));
    const fields = { profile: part("profile").value, token: part("token")?.value };
    const sent = sending(archive, name, fields, (share) => show("Sending", share));
    stop = sent.stop;
    const { id } = await sent.answer;
    location.assign(`/checks/${encodeURIComponent(id)}`);
  } catch (problem) {
    busy(false);
    refuse(problem);
    part("check").focus();
  }
}

part("file").addEventListener("change", (event) => {
  part("folder").value = "";
  take(() => [...event.target.files].map((file) => ({ path: file.name, file })));
});
part("folder").addEventListener("change", (event) => {
  part("file").value = "";
  take(() => ofFolder(event.target.files, limits.files));
});
part("stop").addEventListener("click", () => stop?.());
form.addEventListener("submit", (event) => {
  event.preventDefault();
  if (given) send();
  else if (!part("refusal").textContent) refuse(new Refusal("No file is chosen. Choose an archive, a model file or a package folder."));
});

// Anywhere on the page will do: a drop beside the zone would make the browser leave the page.
let inside = 0;
const mark = (step) => {
  inside = Math.max(0, inside + step);
  part("drop").classList.toggle("over", inside > 0);
};
addEventListener("dragenter", () => mark(1));
addEventListener("dragleave", () => mark(-1));
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  mark(-inside);
  const transfer = event.dataTransfer;
  if (part("check").disabled || ![...transfer.types].includes("Files")) return;
  part("file").value = "";
  part("folder").value = "";
  const found = dropped(transfer, limits.files);
  take(() => found);
});
// Back from a check, the page may be shown as it was left.
addEventListener("pageshow", () => busy(false));
