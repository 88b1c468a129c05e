"use strict";
// Tables: show one level, or all.
for (const input of document.querySelectorAll('input[name="level"]')) {
  input.addEventListener("change", () => {
    for (const part of document.querySelectorAll("[data-spp]")) {
      part.hidden = input.value !== "all" && part.dataset.spp !== input.value;
    }
  });
}
