// The moment of the trial that the plots mark; a press on a plot chooses another one. Of several
// robots, these are the plots of the one in 3D.
const subtPlots = (() => {
  const fields = [...document.querySelectorAll(".in-view .plot .field")];
  const subtPlotsPublic = { onSeek: null, show };

  function show(share) {
    for (const field of fields) field.querySelector(".now").style.left = `${100 * share}%`;
  }

  function seek(event) {
    const box = event.currentTarget.getBoundingClientRect();
    const share = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    show(share);
    subtPlotsPublic.onSeek?.(share);
  }

  for (const field of fields) {
    field.addEventListener("pointerdown", seek);
    field.addEventListener("pointermove", (event) => { if (event.buttons & 1) seek(event); });
  }

  // A link to the trial of another robot unfolds it.
  const unfold = () => {
    const chosen = document.getElementById(location.hash.slice(1));
    if (chosen?.matches("details")) chosen.open = true;
  };
  addEventListener("hashchange", unfold);
  unfold();
  return subtPlotsPublic;
})();
