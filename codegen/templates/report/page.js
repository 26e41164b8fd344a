// Values of markers near the pointer, and legends that show and hide series. The page is complete without it.
(() => {
  "use strict";
  const REACH = 28;
  const tip = document.createElement("div");
  tip.className = "tip";
  tip.hidden = true;
  document.body.append(tip);

  const hide = (lit) => {
    tip.hidden = true;
    if (lit) lit.classList.remove("lit");
  };

  for (const svg of document.querySelectorAll("figure svg[role=img]")) {
    const series = (k) => svg.querySelectorAll(`[data-series="${k}"]`);
    const entries = (k) => svg.querySelectorAll(`[data-key="${k}"]`);
    const marks = [];
    let lit = null;

    // The titles are shown beside the pointer; without this, browsers would show them a second time.
    svg.setAttribute("aria-label", svg.querySelector(":scope > title").textContent);
    svg.removeAttribute("aria-labelledby");
    svg.querySelector(":scope > title").remove();
    for (const title of svg.querySelectorAll("use > title")) {
      const mark = title.parentElement;
      marks.push({ mark, text: title.textContent, k: mark.closest("[data-series]").dataset.series });
      title.remove();
    }

    const numbers = new Set([...svg.querySelectorAll("[data-key]")].map((entry) => entry.dataset.key));
    for (const k of numbers) {
      const label = svg.querySelector(`[data-key="${k}"]:has(text)`) ?? entries(k)[0];
      const toggle = () => {
        const off = label.getAttribute("aria-pressed") === "true";
        label.setAttribute("aria-pressed", String(!off));
        for (const part of series(k)) part.classList.toggle("off", off);
        for (const part of entries(k)) part.classList.toggle("dim", off);
        lit = hide(lit);
      };
      label.setAttribute("role", "button");
      label.setAttribute("tabindex", "0");
      label.setAttribute("aria-pressed", "true");
      label.setAttribute("aria-label", `show ${label.textContent.trim()}`);
      for (const part of entries(k)) {
        part.classList.add("entry");
        part.addEventListener("click", toggle);
        part.addEventListener("pointerenter", () => {
          svg.classList.add("focus");
          for (const one of series(k)) one.classList.add("front");
        });
        part.addEventListener("pointerleave", () => {
          svg.classList.remove("focus");
          for (const one of series(k)) one.classList.remove("front");
        });
      }
      label.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        toggle();
      });
    }

    const show = (event) => {
      let best = null;
      let least = REACH;
      for (const one of marks) {
        const box = one.mark.getBoundingClientRect();
        if (!box.width) continue; // a hidden series
        const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
        const distance = Math.hypot(event.clientX - x, event.clientY - y);
        if (distance < least) [best, least] = [{ ...one, x, y }, distance];
      }
      if (lit) lit.classList.remove("lit");
      lit = best && best.mark;
      tip.hidden = !best;
      if (!best) return;
      lit.classList.add("lit");
      tip.textContent = best.text;
      const width = document.documentElement.clientWidth;
      const left = Math.min(Math.max(4, best.x + 12), width - tip.offsetWidth - 4);
      tip.style.left = `${left + window.scrollX}px`;
      tip.style.top = `${best.y - tip.offsetHeight - 10 + window.scrollY}px`;
    };
    svg.addEventListener("pointermove", show);
    svg.addEventListener("pointerdown", show);
    svg.addEventListener("pointerleave", () => {
      lit = hide(lit);
    });
  }
})();
