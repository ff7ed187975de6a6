"use strict";
(() => {
  const drawings = JSON.parse(document.getElementById("drawings").textContent);
  const themes = window.matchMedia("screen and (prefers-color-scheme: dark)");
  // All buttons are named, because Plotly's own set has one that sends the figure to a server.
  const config = {
    displaylogo: false,
    responsive: false,
    plotlyServerURL: "",
    modeBarButtons: [["toImage", "zoom2d", "pan2d", "zoomIn2d", "zoomOut2d", "resetScale2d"]],
  };
  const narrow = 560; // px: below it, axes take less room
  let onPaper = null; // width of the page [px] while it is printed

  // Put in what a property of the style sheet is: "var(--ink)" becomes "#222222".
  function resolved(value, style) {
    if (typeof value === "string") {
      const name = /^var\((--[a-z-]+)\)$/.exec(value);
      return name ? style.getPropertyValue(name[1]).trim() : value;
    }
    if (Array.isArray(value)) return value;
    if (value === null || typeof value !== "object") return value;
    return Object.fromEntries(Object.entries(value).map(([key, item]) =>
      [key, Array.isArray(item) && typeof item[0] === "object" && item[0] !== null && !Array.isArray(item[0])
        ? item.map((part) => resolved(part, style)) : resolved(item, style)]));
  }

  // Leave out names of supports that would be written over the one before.
  function legible(names, range, width, size) {
    const left = (name) => ((name.x - range[0]) / (range[1] - range[0])) * width - 0.3 * size * name.text.length;
    let end = -Infinity;
    return names.filter((name) => {
      if (left(name) < end) return false;
      end = left(name) + 0.6 * size * name.text.length + 6;
      return true;
    });
  }

  function draw(one) {
    const place = document.getElementById(one.id);
    const style = getComputedStyle(document.documentElement);
    const layout = resolved(one.layout, style);
    const width = onPaper ?? place.clientWidth;
    layout.width = width;
    layout.height = Math.round(one.layout.height * (onPaper ? 0.82 : 1));
    place.style.height = layout.height + "px";
    if (onPaper) layout.font = {...layout.font, size: 10};
    else if (width < narrow) {
      layout.margin = {...layout.margin, l: 58, r: 6};
      layout.font = {...layout.font, size: 11};
    }
    const inner = width - layout.margin.l - layout.margin.r;
    layout.annotations = legible(layout.annotations, layout.xaxis.range, inner, layout.font.size);
    if (place.layout && !onPaper) { // keep what the reader has zoomed to
      for (const axis of ["xaxis", "yaxis"]) {
        const shown = place.layout[axis];
        if (shown && place.zoomed) layout[axis] = {...layout[axis], range: shown.range.slice(), autorange: false};
      }
    }
    const shown = {...config, displayModeBar: width < narrow ? false : "hover"};
    Plotly.react(place, one.data.map((trace) => resolved(trace, style)), layout, shown);
    if (!place.listening) {
      place.listening = true;
      place.on("plotly_relayout", (event) => {
        if (Object.keys(event).some((key) => key.includes("range"))) place.zoomed = true;
        if (Object.keys(event).some((key) => key.includes("autorange"))) place.zoomed = false;
      });
    }
  }

  const drawAll = () => drawings.forEach(draw);

  // On paper: light colours, the width of the page, nothing folded. Chromium lays the page out before it prints.
  let folded = [];
  function toPaper() {
    if (onPaper !== null) return;
    document.documentElement.classList.add("paper");
    folded = [...document.querySelectorAll("details:not([open])")];
    folded.forEach((fold) => { fold.open = true; });
    onPaper = 690;
    drawAll();
  }
  function toScreen() {
    document.documentElement.classList.remove("paper");
    folded.forEach((fold) => { fold.open = false; });
    onPaper = null;
    drawAll();
  }

  for (const button of document.querySelectorAll("button.unfold")) {
    const folds = [...button.closest("section").querySelectorAll("details")];
    const unfolded = () => folds.every((fold) => fold.open);
    const tell = () => { button.textContent = unfolded() ? "Fold all" : "Unfold all"; };
    button.addEventListener("click", () => {
      const open = !unfolded();
      folds.forEach((fold) => { fold.open = open; });
    });
    folds.forEach((fold) => fold.addEventListener("toggle", tell));
    button.hidden = folds.length < 2;
    tell();
  }

  let waiting = 0;
  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth === width || onPaper !== null) return;
    width = window.innerWidth;
    clearTimeout(waiting);
    waiting = setTimeout(drawAll, 120);
  });
  themes.addEventListener("change", drawAll);
  window.addEventListener("beforeprint", toPaper);
  window.addEventListener("afterprint", toScreen);
  if (location.hash === "#paper") toPaper(); else drawAll();
  document.documentElement.dataset.ready = "yes";
})();
