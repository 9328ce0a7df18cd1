// Conveniences only: the page says everything without this script.
"use strict";
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const one = (selector, root = document) => root.querySelector(selector);

  // Filter by verdict and search.
  const tools = one(".tools");
  if (tools) {
    const claims = all("#claims .claim").map((element) => ({ element, text: element.textContent.toLowerCase() }));
    const field = one("input", tools);
    let verdict = "";
    const show = () => {
      const wanted = field.value.trim().toLowerCase();
      let count = 0;
      for (const { element, text } of claims) {
        const fits = (!verdict || element.dataset.verdict === verdict) && text.includes(wanted);
        element.hidden = !fits;
        count += fits;
      }
      for (const part of all("#claims .part")) part.hidden = !one(".claim:not([hidden])", part);
      for (const button of all("button", tools)) button.ariaPressed = String(button.dataset.verdict === verdict);
      one(".shown", tools).textContent = `${count} of ${claims.length}`;
    };
    const choose = (wanted) => { verdict = wanted; show(); };
    tools.hidden = false;
    field.addEventListener("input", show);
    tools.addEventListener("click", (event) => {
      const button = event.target.closest("button");
      if (button) choose(button.dataset.verdict);
    });
    for (const segment of all(".segment")) segment.addEventListener("click", () => choose(segment.dataset.verdict));
    // A link to a claim that is filtered away shows it again.
    addEventListener("hashchange", () => {
      const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
      if (!target || !target.hidden) return;
      field.value = "";
      choose("");
      target.scrollIntoView();
    });
    show();
  }

  // Highlight in the graph.
  const graph = one(".graph");
  const titles = one("#titles");
  if (graph && titles) {
    const names = JSON.parse(titles.textContent);
    const arcs = all(".arc", graph).map((element) => ({ element, from: element.dataset.from, to: element.dataset.to }));
    const nodes = new Map(all(".node", graph).map((element) => [element.dataset.id, element]));
    const step = { up: (id) => arcs.filter((a) => a.to === id).map((a) => a.from),
      down: (id) => arcs.filter((a) => a.from === id).map((a) => a.to) };
    const reached = (id, next) => {
      const found = new Set(), queue = [id];
      while (queue.length) for (const other of next(queue.shift())) if (!found.has(other)) { found.add(other); queue.push(other); }
      return found;
    };
    const inOrder = (ids) => [...nodes.keys()].filter((id) => ids.has(id));
    const link = (id) => {
      const a = document.createElement("a");
      a.href = `#claim-${id}`;
      a.textContent = id;
      a.className = "id";
      return a;
    };
    const list = (place, id, next) => {
      const near = new Set(next(id)), far = reached(id, next);
      for (const x of near) far.delete(x);
      far.delete(id);
      place.replaceChildren();
      for (const x of inOrder(near)) place.append(link(x), " ");
      if (far.size) {
        const further = document.createElement("span");
        further.className = "further";
        further.append(near.size ? "and through them " : "");
        for (const x of inOrder(far)) further.append(link(x), " ");
        place.append(further);
      }
      if (!near.size) place.append("nothing");
    };
    let pinned = null;
    const light = (id) => {
      graph.classList.toggle("lit", id !== null);
      if (id === null) return;
      const up = reached(id, step.up), down = reached(id, step.down);
      for (const { element, from, to } of arcs) {
        element.classList.toggle("near", from === id || to === id);
        element.classList.toggle("far", (up.has(from) && up.has(to)) || (down.has(from) && down.has(to)));
      }
      for (const [name, node] of nodes) {
        node.classList.toggle("on", name === id || up.has(name) || down.has(name));
        node.classList.toggle("self", name === id);
      }
      const head = one(".chosen h3 a");
      head.href = `#claim-${id}`;
      head.textContent = id;
      one(".chosen .gloss").textContent = names[id] || "";
      list(one(".chosen .up"), id, step.up);
      list(one(".chosen .down"), id, step.down);
      one(".chosen").hidden = false;
      one(".picked .hint").hidden = true;
    };
    for (const [id, node] of nodes) {
      node.addEventListener("mouseenter", () => light(id));
      node.addEventListener("mouseleave", () => light(pinned));
      node.addEventListener("focus", () => { pinned = id; light(id); });
      node.addEventListener("click", (event) => { event.preventDefault(); pinned = id; light(id); });
    }
  }

  // On paper everything is unfolded.
  let folded = [];
  addEventListener("beforeprint", () => { folded = all("details:not([open])"); for (const d of folded) d.open = true; });
  addEventListener("afterprint", () => { for (const d of folded) d.open = false; });
})();
