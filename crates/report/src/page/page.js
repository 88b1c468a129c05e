"use strict";
// Tables: show one level, or all. Every switch of the page moves with the others.
const switches = document.querySelectorAll('input[name^="level-"]');
for (const input of switches) {
  input.addEventListener("change", () => {
    const before = input.getBoundingClientRect().top;
    for (const other of switches) other.checked = other.value === input.value;
    for (const part of document.querySelectorAll("[data-spp]")) {
      part.hidden = input.value !== "all" && part.dataset.spp !== input.value;
    }
    // Parts above may have changed their height: what was touched stays where it is.
    window.scrollBy(0, input.getBoundingClientRect().top - before);
  });
}
