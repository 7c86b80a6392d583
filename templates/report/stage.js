// The 3D view and its controls; where it cannot start, the pictures stay.
(async () => {
  const stage = document.querySelector(".stage");
  const source = document.getElementById("glb");
  const host = stage?.querySelector(".view");
  if (!host || !source || typeof SubtCheckViewer === "undefined") return;

  const LAYERS = {
    visual: "Visual", collision: "Collision", inertia: "Inertia", frame: "Frames",
    joint: "Joints", mass: "Mass", view: "Sensor views",
  };
  const find = (selector) => stage.querySelector(selector);
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const theme = () => (dark.matches ? "dark" : "light");
  const bytes = (url) => {
    const text = atob(url.slice(url.indexOf(",") + 1));
    const array = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i += 1) array[i] = text.charCodeAt(i);
    return array.buffer;
  };

  let viewer;
  host.hidden = false;
  try {
    viewer = await SubtCheckViewer.create(host, bytes(source.href), {
      theme: theme(),
      reducedMotion: matchMedia("(prefers-reduced-motion: reduce)").matches,
    });
  } catch (error) {
    host.hidden = true;
    stage.dataset.trouble = error.message;
    return;
  }
  stage.classList.add("live");
  find(".controls").hidden = false;
  dark.addEventListener("change", () => viewer.setTheme(theme()));

  playback();
  layers();
  views();
  selection();
  window.subtCheckStage = viewer;

  function playback() {
    const [button, slider, moment, speed] =
      [".play-button", ".time", ".moment", ".speed"].map(find);
    const duration = viewer.duration;
    const { legs } = subtPlots;
    find(".play").hidden = duration === 0;
    find(".leg").hidden = duration === 0 || legs.length === 0;
    if (duration === 0) return;

    const show = (time) => {
      slider.value = time;
      moment.textContent = `${time.toFixed(2)} s`;
      button.textContent = viewer.playing ? "Pause" : "Play";
      find(".leg").textContent = legs.find((leg) => time < leg.end)?.name ?? "";
      subtPlots.show(time);
    };
    const seek = (time) => { viewer.seek(time); show(time); };
    slider.max = duration;
    viewer.onTime = show;
    slider.addEventListener("input", () => seek(Number(slider.value)));
    speed.addEventListener("change", () => { viewer.speed = Number(speed.value); });
    button.addEventListener("click", () => {
      if (viewer.playing) viewer.pause();
      else {
        if (Number(slider.value) >= duration - 0.01) viewer.seek(0);
        viewer.play();
      }
      button.textContent = viewer.playing ? "Pause" : "Play";
    });
    // The plots go on to the end of the course, the replay to its last sample.
    subtPlots.onSeek = (time) => seek(Math.min(time, duration));
    show(0);
  }

  function layers() {
    const list = find(".layers");
    for (const name of Object.keys(LAYERS).filter((each) => viewer.layers.includes(each))) {
      const label = document.createElement("label");
      const box = document.createElement("input");
      box.type = "checkbox";
      box.dataset.layer = name;
      box.checked = name === "visual";
      label.append(box, LAYERS[name]);
      list.append(label);
    }
    const refresh = () => {
      const on = new Set([...list.querySelectorAll(":checked")].map((box) => box.dataset.layer));
      const others = on.size - (on.has("visual") ? 1 : 0);
      for (const box of list.querySelectorAll("input")) {
        const name = box.dataset.layer;
        // What lies inside is seen through the skin.
        if (name === "visual") {
          viewer.setLayer(name, on.has(name) ? (others ? "transparent" : "opaque") : "off");
        } else viewer.setLayer(name, on.has(name));
      }
    };
    list.addEventListener("change", refresh);
  }

  function views() {
    for (const button of stage.querySelectorAll("[data-view]")) {
      button.addEventListener("click", () => viewer.view(button.dataset.view));
    }
    const follow = find(".follow");
    follow.hidden = viewer.duration === 0;
    viewer.follow = true;
    follow.addEventListener("click", () => {
      viewer.follow = !viewer.follow;
      follow.setAttribute("aria-pressed", String(viewer.follow));
    });
  }

  function selection() {
    const chosen = find(".chosen");
    const linkTo = (finding, words) => {
      const link = document.createElement("button");
      link.type = "button";
      link.className = "link";
      link.textContent = words;
      link.addEventListener("click", () => finding.scrollIntoView({ block: "center" }));
      return link;
    };
    // `from` is the finding that asked to see the part, where one did.
    const say = (path, name, from) => {
      const found = subtFindings.choosePart(path, name);
      if (!path) chosen.textContent = "Click a part to see its findings.";
      else if (!found.length) chosen.textContent = `${name}: no findings.`;
      else {
        const words = found.length === 1 ? "1 finding" : `${found.length} findings`;
        chosen.replaceChildren(`${name}: `, linkTo(from ?? found[0], from ? "back to the finding" : words));
      }
    };
    viewer.onSelect = (path, name) => say(path, name);

    for (const finding of document.querySelectorAll(".finding[data-elements]")) {
      const button = finding.querySelector(".show");
      const part = subtFindings.elementsOf(finding).map((path) => viewer.partOf(path)).find(Boolean);
      if (!button || !part) continue;
      button.hidden = false;
      button.addEventListener("click", () => {
        viewer.select(part.element);
        say(part.element, part.name, finding);
        finding.classList.add("selected");
        stage.scrollIntoView({ block: "nearest" });
      });
    }
  }
})();
