// Which findings are shown: by words, severity, concern, rule, and of the part that is selected.
"use strict";

const subtFindings = (() => {
  document.documentElement.classList.add("scripted");
  const findings = [...document.querySelectorAll("article.finding")];
  const form = document.querySelector("form.filters");
  const ofPart = document.querySelector(".of-part");
  const onlyPart = ofPart?.querySelector("input");
  const words = new Map(findings.map((each) => [each, each.textContent.toLowerCase()]));
  let part = "";

  const elementsOf = (finding) => (finding.dataset.elements || "").split("\n").filter(Boolean);

  // An element's path names the part when it is the part's own path or goes on below it.
  const isBelow = (path, top) => path === top || path.startsWith(top + "/");
  const concerns = (finding) => elementsOf(finding).some((path) => isBelow(path, part));

  const chosen = (name) => new Set(
    [...form.querySelectorAll(`input[name=${name}]`)].filter((box) => box.checked).map((box) => box.value),
  );

  const refresh = () => {
    if (!form) return;
    const [severities, topics] = [chosen("severity"), chosen("concern")];
    const rule = form.elements.rule.value;
    const sought = form.querySelector("[type=search]").value.toLowerCase().split(/\s+/).filter(Boolean);
    const anyTopic = !form.querySelector("input[name=concern]");
    let number = 0;
    for (const finding of findings) {
      const { severity, concern, rule: own } = finding.dataset;
      const wanted = severities.has(severity) && (anyTopic || topics.has(concern)) &&
        (!rule || own === rule) && sought.every((word) => words.get(finding).includes(word)) &&
        !(part && onlyPart.checked && !concerns(finding));
      finding.hidden = !wanted;
      number += wanted ? 1 : 0;
    }
    for (const grade of document.querySelectorAll(".grade")) {
      grade.hidden = !grade.querySelector("article.finding:not([hidden])");
      // Who looks for something sees it, be it an info.
      if (grade.matches("details") && (sought.length || rule) && !grade.hidden) grade.open = true;
    }
    form.querySelector(".shown").textContent =
      number === findings.length ? "" : `${number} of ${findings.length} shown`;
  };

  // Returns how many findings are about a part, and offers to show these alone.
  const choosePart = (path, name) => {
    part = path;
    const found = path ? findings.filter(concerns) : [];
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

  // Where a link leads is unfolded, and shown whatever the filters say.
  const reveal = (target) => {
    if (target.matches("article.finding[hidden]")) {
      form.reset();
      refresh();
    }
    for (let each = target; each; each = each.parentElement) {
      if (each.matches("details")) each.open = true;
    }
  };
  const follow = () => {
    const target = document.getElementById(location.hash.slice(1));
    if (!target) return;
    reveal(target);
    target.scrollIntoView();
  };

  // On paper nothing can be unfolded.
  let folded = [];
  addEventListener("beforeprint", () => {
    folded = [...document.querySelectorAll("details:not([open], .patch, .why)")];
    folded.forEach((each) => { each.open = true; });
  });
  addEventListener("afterprint", () => folded.forEach((each) => { each.open = false; }));

  const copy = async (link) => {
    const said = link.textContent;
    try {
      await navigator.clipboard.writeText(link.href);
      link.textContent = "Link copied";
    } catch {
      return; // the address bar shows it all the same
    }
    setTimeout(() => { link.textContent = said; }, 2000);
  };

  for (const link of document.querySelectorAll("a.copy")) {
    link.textContent = "Copy link";
    link.addEventListener("click", () => copy(link));
  }
  form?.addEventListener("keydown", (event) => { if (event.key === "Enter" && event.target.type === "search") event.preventDefault(); });
  form?.addEventListener("input", refresh);
  addEventListener("hashchange", follow);
  follow();
  return { choosePart, elementsOf, reveal };
})();
