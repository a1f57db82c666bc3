"use strict";
// What a page can do in a browser: figures enlarge, zoom and save as SVG or PNG, charts show the numbers under the
// pointer, tables save as CSV, a slider chooses among figures that otherwise stand one under the other. Without it the
// page reads the same.
(() => {
  const make = (tag, text) => Object.assign(document.createElement(tag), { textContent: text });
  const button = (text, what, act) => {
    const made = make("button", text);
    made.title = what;
    made.addEventListener("click", act);
    return made;
  };
  const save = (name, blob) => {
    const link = make("a", "");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const tools = (...parts) => {
    const bar = make("div", "");
    bar.className = "tools";
    bar.append(...parts);
    return bar;
  };

  // --- tables --------------------------------------------------------------------------------------------------------
  const cell = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const csv = (table) => [...table.rows].map((row) => [...row.cells].map((one) => cell(one.textContent)).join(",")).join("\n") + "\n";
  document.querySelectorAll("table").forEach((table, place) => {
    const act = () => save(`table-${place + 1}.csv`, new Blob([csv(table)], { type: "text/csv" }));
    (table.closest(".scroll") || table).after(tools(button("CSV", "save this table", act)));
  });

  // --- figures of one value at a time --------------------------------------------------------------------------------
  document.querySelectorAll(".steps").forEach((steps) => {
    const parts = [...steps.children];
    const slider = Object.assign(make("input", ""), { type: "range", min: 0, max: parts.length - 1 });
    slider.value = Math.floor(parts.length / 2);
    const label = make("label", "");
    const shown = make("span", "");
    label.className = "slider";
    label.append(shown, slider);
    const show = () => {
      parts.forEach((part, place) => { part.hidden = place !== Number(slider.value); });
      shown.textContent = parts[slider.value].querySelector("h3").textContent;
    };
    slider.addEventListener("input", show);
    steps.before(label);
    show();
  });

  // --- figures -------------------------------------------------------------------------------------------------------
  const box = (svg) => svg.getAttribute("viewBox").split(" ").map(Number);
  const text = (svg) => new XMLSerializer().serializeToString(svg);
  const savePng = (svg, name) => {
    const [, , width, height] = box(svg);
    const picture = new Image();
    const copy = svg.cloneNode(true);
    copy.setAttribute("width", width);
    copy.setAttribute("height", height);
    picture.onload = () => {
      const canvas = Object.assign(make("canvas", ""), { width: 3 * width, height: 3 * height });
      const pen = canvas.getContext("2d");
      pen.fillStyle = "white";
      pen.fillRect(0, 0, canvas.width, canvas.height);
      pen.drawImage(picture, 0, 0, canvas.width, canvas.height);
      canvas.toBlob((blob) => save(name, blob));
    };
    picture.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(text(copy));
  };

  // The numbers of an axis from its ticks: value = a + b place, or its logarithm where the ticks are powers.
  const axis = (ticks) => {
    if (ticks.length < 2) return null;
    const straight = (values) => {
      const n = values.length - 1;
      const b = (values[n] - values[0]) / (ticks[n].at - ticks[0].at);
      const off = Math.max(...values.map((value, i) => Math.abs(values[0] + b * (ticks[i].at - ticks[0].at) - value)));
      return off <= 0.02 * Math.abs(values[n] - values[0]) ? (at) => values[0] + b * (at - ticks[0].at) : null;
    };
    const plain = straight(ticks.map((tick) => tick.value));
    if (plain || ticks.some((tick) => tick.value <= 0)) return plain;
    const power = straight(ticks.map((tick) => Math.log(tick.value)));
    return power && ((at) => Math.exp(power(at)));
  };
  const axes = (svg) => {
    const place = (one, key) => Number(one.getAttribute(key));
    const all = [...svg.querySelectorAll("text[x]")].map((one) => ({
      x: place(one, "x"), y: place(one, "y"), anchor: one.getAttribute("text-anchor"),
      value: one.textContent.trim() === "" ? null : Number(one.textContent.trim().replace("−", "-")),
    })).filter((one) => Number.isFinite(one.value));
    // Ticks along x stand in one line, those along y end in one column.
    const line = (anchor, key, at) => {
      const groups = new Map();
      all.filter((one) => one.anchor === anchor).forEach((one) => {
        const name = Math.round(one[key]);
        groups.set(name, [...(groups.get(name) || []), { at: one[at], value: one.value }]);
      });
      return axis([...groups.values()].sort((a, b) => b.length - a.length)[0] || []);
    };
    return [line("middle", "y", "x"), line("end", "x", "y")];
  };
  const short = (value) => Number(value.toPrecision(3)).toString();

  document.querySelectorAll("figure").forEach((figure) => {
    const svg = figure.querySelector("svg");
    if (!svg) return;
    const whole = svg.getAttribute("viewBox");
    const large = () => figure.classList.contains("large");
    const toggle = () => {
      figure.classList.toggle("large");
      svg.setAttribute("viewBox", whole);
    };
    const readout = make("output", "");
    figure.querySelector("figcaption").before(tools(
      button("enlarge", "over the whole window; the wheel zooms, Esc closes", toggle),
      button("SVG", "save this figure", () => save(`${figure.id}.svg`, new Blob([text(svg)], { type: "image/svg+xml" }))),
      button("PNG", "save this figure", () => savePng(svg, `${figure.id}.png`)),
      readout));
    const [x, y] = axes(svg);
    const at = (event) => new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    svg.addEventListener("pointermove", (event) => {
      const here = at(event);
      readout.textContent = [x && `x ${short(x(here.x))}`, y && `y ${short(y(here.y))}`].filter(Boolean).join(", ");
      if (large() && event.buttons === 1) {
        const [left, top, width, height] = box(svg);
        const scale = width / svg.getBoundingClientRect().width;
        svg.setAttribute("viewBox", [left - event.movementX * scale, top - event.movementY * scale, width, height].join(" "));
      }
    });
    svg.addEventListener("pointerleave", () => { readout.textContent = ""; });
    svg.addEventListener("wheel", (event) => {
      if (!large()) return;
      event.preventDefault();
      const here = at(event);
      const [left, top, width, height] = box(svg);
      const factor = event.deltaY < 0 ? 0.8 : 1.25;
      svg.setAttribute("viewBox", [here.x + (left - here.x) * factor, here.y + (top - here.y) * factor, width * factor, height * factor].join(" "));
    }, { passive: false });
    document.addEventListener("keydown", (event) => { if (event.key === "Escape" && large()) toggle(); });
  });
})();
