// The plots of each trial. Those of the robot in 3D follow its replay, and a press on them chooses
// another moment.
const subtPlots = (() => {
  const groups = [...document.querySelectorAll(".plots[data-plots]")];
  const ours = { onSeek: null, show, legs: [] };
  let moment = 0;
  const followers = [];
  if (typeof SubtCheckViewer === "undefined") {
    for (const group of groups) group.querySelector(".without-script").textContent = "The plots need the viewer, which was not built; subt-check doctor says more.";
    return ours;
  }
  document.documentElement.classList.add("plotted");
  const drawn = [];
  for (const [number, group] of groups.entries()) {
    const course = JSON.parse(group.dataset.plots);
    const followsReplay = Boolean(group.closest(".in-view"));
    if (followsReplay) ours.legs = course.legs;
    const hosts = [...group.querySelectorAll(".plot .field")];
    const own = [];
    const draw = () => {
      if (own.length || !hosts[0]?.clientWidth) return;
      let chosen = 0;
      const shared = () => (followsReplay && ours.onSeek ? moment : chosen);
      const ties = {
        group: `trial-${number}`,
        seek: (time) => {
          chosen = time;
          own.forEach((each) => each.show(time));
          if (followsReplay) ours.onSeek?.(time);
        },
        leave: () => own.forEach((each) => each.show(shared())),
      };
      own.push(...hosts.map((host, index) => SubtCheckViewer.plot(host, course.plots[index], course, ties)));
      drawn.push(...own);
      if (followsReplay) followers.push(...own);
      own.forEach((each) => each.show(followsReplay ? moment : 0));
    };
    draw();
    group.closest("details")?.addEventListener("toggle", draw);
  }

  function show(time) {
    moment = time;
    for (const each of followers) each.show(time);
  }

  for (const query of ["(prefers-color-scheme: dark)", "print"]) {
    matchMedia(query).addEventListener("change", () => drawn.forEach((each) => each.repaint()));
  }
  return ours;
})();
