// Keeps the page of a check fresh: each event fetches the page, and what differs is put in its place.

document.documentElement.classList.add("scripted");
const EVERY = 3000; // ms between looks while no events are heard
const MEANWHILE = 10000; // ms since the last look, else: the queue moves without telling
const part = (id, page = document) => page.getElementById(id);
const check = part("check");
let events = null;
let timer = 0;
let looked = Date.now();
let looking = false;
let again = false;

function say(words) {
  if (part("news").textContent !== words) part("news").textContent = words;
}

// Puts one part of a fresh page in the place of ours; who stood on a button in it is not lost.
function renew(ours, fresh) {
  if (ours.outerHTML === fresh.outerHTML) return;
  const held = ours.contains(document.activeElement);
  ours.replaceWith(document.adoptNode(fresh));
  if (!held) return;
  const next = fresh.querySelector("a, button") ?? part("headline");
  if (next.id === "headline") next.tabIndex = -1;
  next.focus();
}

async function look() {
  const answer = await fetch(location.pathname, { cache: "no-store", credentials: "same-origin" });
  if (answer.status >= 500) throw new Error(`status ${answer.status}`);
  const page = new DOMParser().parseFromString(await answer.text(), "text/html");
  const fresh = part("check", page);
  if (!fresh) return location.reload(); // it is gone, and the page says so
  for (const ours of [...check.querySelectorAll(".fresh")]) renew(ours, part(ours.id, page));
  document.title = page.title;
  say(part("headline").querySelector(".sentence").textContent.trim());
  if ("final" in fresh.dataset) finish();
}

// One look at a time; an event that comes meanwhile is worth one more.
async function refresh() {
  again = looking;
  if (looking) return;
  looking = true;
  looked = Date.now();
  try {
    await look();
  } catch {
    say("The service does not answer; trying again.");
  } finally {
    looking = false;
  }
  if (again && events) refresh();
}

function finish() {
  events?.close();
  events = null;
  clearInterval(timer);
}

function lookNowAndThen() {
  const hears = events.readyState === EventSource.OPEN;
  if (!hears || Date.now() - looked >= MEANWHILE) refresh();
}

function watch() {
  events = new EventSource(check.dataset.events);
  events.addEventListener("message", refresh);
  timer = setInterval(lookNowAndThen, EVERY);
}

if (!("final" in check.dataset)) watch();
// Who comes by a link from elsewhere brings no cookie along: asked for from here, the page has what
// only its sender may do.
else if (!("mine" in check.dataset)) look().catch(() => {});

const link = part("link");
link.addEventListener("focus", () => link.select());
if (navigator.clipboard) {
  const copy = part("copy");
  copy.hidden = false;
  copy.addEventListener("click", async () => {
    await navigator.clipboard.writeText(link.value);
    say("The link is copied.");
    copy.textContent = "Copied";
    setTimeout(() => (copy.textContent = "Copy"), 3000);
  });
}
