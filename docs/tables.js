// Tables with many columns become cards on a phone: every cell gets the name of its column, which style.css shows there.
const MANY = 4;
const VERY_MANY = 9;

function nameCells() {
  for (const table of document.querySelectorAll(".md-typeset table:not([class], [data-wide])")) {
    const names = [...table.querySelectorAll("thead th")].map((cell) => cell.textContent.trim());
    if (names.length < MANY) continue;
    table.dataset.wide = names.length < VERY_MANY ? "" : "very";
    for (const row of table.tBodies[0].rows) {
      [...row.cells].forEach((cell, column) => {
        cell.dataset.label = names[column];
        if (!cell.hasChildNodes()) return;
        const value = document.createElement("span");
        value.className = "value";
        value.append(...cell.childNodes);
        cell.append(value);
      });
    }
  }
}

document$.subscribe(nameCells); // the theme says so at each page, also when it is loaded in place
