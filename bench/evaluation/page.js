// The sliders: where the border between two images is, and which two they are.
for (const figure of document.querySelectorAll(".comparison")) {
  const compare = figure.querySelector(".compare");
  compare.querySelector("input").addEventListener("input", (e) => compare.style.setProperty("--x", e.target.value + "%"));
  for (const select of figure.querySelectorAll("select")) {
    const pane = compare.querySelector("." + select.name);
    select.addEventListener("change", () => { pane.className = "picture " + select.name + " " + select.value; });
  }
}
// The false-colour maps: one quantity at a time.
for (const figure of document.querySelectorAll(".sheets")) {
  const sheets = figure.querySelectorAll(".sheet");
  figure.querySelector("select").addEventListener("change", (e) => sheets.forEach((s, k) => { s.hidden = k != e.target.value; }));
}
