"use strict";
// What a mark stands for: on the pointer, on touch, on the keyboard's focus.
const tip = document.getElementById("tip");
let near = null;

function show(hit) {
  if (near) near.classList.remove("near");
  near = hit;
  tip.hidden = !hit;
  if (!hit) return;
  hit.classList.add("near");
  const lines = hit.getAttribute("aria-label").split("\n");
  const head = document.createElement("b");
  head.textContent = lines[0];
  tip.replaceChildren(head, ...lines.slice(1).map((line) => {
    const row = document.createElement("div");
    const name = document.createElement("span");
    const value = document.createElement("em");
    const colon = line.indexOf(": ");
    name.textContent = line.slice(0, colon);
    value.textContent = line.slice(colon + 2);
    row.append(name, value);
    return row;
  }));
  const box = hit.getBoundingClientRect();
  const [width, height] = [tip.offsetWidth, tip.offsetHeight];
  const right = box.right + 8;
  const left = right + width < innerWidth ? right : box.left - width - 8;
  tip.style.left = Math.max(8, Math.min(left, innerWidth - width - 8)) + "px";
  // Where there is no room beside the mark, above or below it.
  const beside = left >= 8;
  const below = box.bottom + 8 + height < innerHeight ? box.bottom + 8 : box.top - height - 8;
  const top = beside ? box.top - height / 2 : below;
  tip.style.top = Math.max(8, Math.min(top, innerHeight - height - 8)) + "px";
}

for (const svg of document.querySelectorAll(".chart svg")) {
  const hits = [...svg.querySelectorAll(".hit")];
  hits.sort((a, b) => a.cx.baseVal.value - b.cx.baseVal.value || a.cy.baseVal.value - b.cy.baseVal.value);
  for (const hit of hits) {
    const title = hit.querySelector("title");
    hit.setAttribute("aria-label", title.textContent);
    hit.setAttribute("role", "img");
    // One stop a chart for the tabulator key; arrows go on from there, left to right.
    hit.setAttribute("tabindex", hit === hits[0] ? "0" : "-1");
    // Otherwise browsers show it too.
    title.remove();
    hit.addEventListener("focus", () => show(hit));
    hit.addEventListener("blur", () => show(null));
    hit.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      const next = step && hits[hits.indexOf(hit) + step];
      if (step) event.preventDefault();
      if (next) next.focus();
    });
  }
  const nearest = (event) => {
    let found = null;
    let least = 24;
    for (const hit of hits) {
      const box = hit.getBoundingClientRect();
      const x = box.left + box.width / 2 - event.clientX;
      const y = box.top + box.height / 2 - event.clientY;
      const distance = Math.hypot(x, y);
      if (distance < least) [least, found] = [distance, hit];
    }
    if (found !== near) show(found);
  };
  svg.addEventListener("pointermove", nearest);
  svg.addEventListener("pointerdown", nearest);
  svg.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") show(null); });
}
addEventListener("keydown", (event) => { if (event.key === "Escape") show(null); });
addEventListener("pointerdown", (event) => { if (!event.target.closest(".chart svg")) show(null); });
addEventListener("scroll", () => { if (near) show(near === document.activeElement ? near : null); }, true);

// Tables sort by the head that is clicked on; again, the other way round.
const key = (row, column) => {
  const cell = row.cells[column];
  return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
};
for (const table of document.querySelectorAll("table")) {
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => head.firstElementChild.addEventListener("click", () => {
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach((other) => other.setAttribute("aria-sort", "none"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const sign = down ? -1 : 1;
    const rows = [...table.tBodies[0].rows].map((row) => [key(row, column), row]);
    rows.sort(([a], [b]) => sign * (typeof a === "string" ? a.localeCompare(b) : a < b ? -1 : a > b ? 1 : 0));
    table.tBodies[0].append(...rows.map(([, row]) => row));
  }));
}

// Rows that hold every word.
const filter = document.getElementById("filter");
const rows = [...document.querySelectorAll("#runs tbody tr")];
filter.addEventListener("input", () => {
  const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
  let count = 0;
  for (const row of rows) {
    const text = row.textContent.toLowerCase();
    row.hidden = !words.every((word) => text.includes(word));
    count += row.hidden ? 0 : 1;
  }
  document.getElementById("shown").textContent = words.length ? `${count} of ${rows.length}` : "";
});
