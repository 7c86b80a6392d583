// The list of packages: sorted by a column, and narrowed to what one looks for.
"use strict";
(() => {
  document.documentElement.classList.add("scripted");
  const table = document.querySelector("table.packages");
  const form = document.querySelector("form.filters");
  const body = table.tBodies[0];
  const rows = [...body.rows];

  const valueOf = (row, column) => row.cells[column].dataset.value ?? row.cells[column].textContent.trim();

  const sort = (head) => {
    const column = head.cellIndex;
    const down = head.getAttribute("aria-sort") === "ascending";
    const compare = head.dataset.sort === "number"
      ? (a, b) => valueOf(a, column) - valueOf(b, column)
      : (a, b) => valueOf(a, column).localeCompare(valueOf(b, column));
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    rows.sort((a, b) => (down ? compare(b, a) : compare(a, b)));
    body.append(...rows);
  };

  for (const head of table.tHead.querySelectorAll("[data-sort]")) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "sorter";
    button.textContent = head.textContent;
    head.replaceChildren(button);
    button.addEventListener("click", () => sort(head));
  }

  form.addEventListener("keydown", (event) => { if (event.key === "Enter") event.preventDefault(); });
  form.addEventListener("input", () => {
    const sought = form.querySelector("[type=search]").value.toLowerCase().split(/\s+/).filter(Boolean);
    let number = 0;
    for (const row of rows) {
      const words = row.textContent.toLowerCase();
      row.hidden = !sought.every((word) => words.includes(word));
      number += row.hidden ? 0 : 1;
    }
    form.querySelector(".shown").textContent = sought.length ? `${number} of ${rows.length} shown` : "";
  });
})();
