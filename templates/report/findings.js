// Which findings are shown: by severity, and of the part that is selected.
"use strict";

const subtFindings = (() => {
  document.documentElement.classList.add("scripted");
  const groups = [...document.querySelectorAll("article.rule")];
  const levels = [...document.querySelectorAll("input[data-severity]")];
  const ofPart = document.querySelector(".of-part");
  const onlyPart = ofPart?.querySelector("input");
  let part = "";

  const elementsOf = (finding) => (finding.dataset.elements || "").split("\n").filter(Boolean);

  // An element's path names the part when it is the part's own path or goes on below it.
  const isBelow = (path, top) => path === top || path.startsWith(top + "/");
  const concerns = (finding) => elementsOf(finding).some((path) => isBelow(path, part));

  const refresh = () => {
    const wanted = new Set(levels.filter((box) => box.checked).map((box) => box.dataset.severity));
    for (const group of groups) {
      let shown = 0;
      for (const finding of group.querySelectorAll(".finding")) {
        const hidden = Boolean(part) && onlyPart.checked && !concerns(finding);
        finding.hidden = hidden;
        shown += hidden ? 0 : 1;
      }
      group.hidden = !wanted.has(group.dataset.severity) || shown === 0;
    }
  };

  // Returns how many findings are about a part, and offers to show these alone.
  const choosePart = (path, name) => {
    part = path;
    const found = path ? [...document.querySelectorAll(".finding")].filter(concerns) : [];
    for (const finding of document.querySelectorAll(".finding.selected")) {
      finding.classList.remove("selected");
    }
    found.forEach((finding) => finding.classList.add("selected"));
    if (ofPart) {
      ofPart.hidden = found.length === 0;
      onlyPart.checked = onlyPart.checked && found.length > 0;
      ofPart.querySelector(".part-name").textContent = name;
    }
    refresh();
    return found;
  };

  levels.forEach((box) => box.addEventListener("change", refresh));
  onlyPart?.addEventListener("change", refresh);
  return { choosePart, elementsOf };
})();
