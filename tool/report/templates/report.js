(() => {
  const height = 330, timeKey = "time", planes = [], plots = [];
  const digits = x => x == null ? "–" : Number(x.toPrecision(4)).toString();
  const dash = s => s.dash.length ? s.dash : undefined;

  // Values of each series over the union of all x; a series has none where it is not given, and lines pass over that.
  const joined = series => uPlot.join(series.map(s => {
    const order = s.x.map((_, k) => k).filter(k => s.x[k] != null).sort((a, b) => s.x[a] - s.x[b]);
    const x = [], y = [];
    for (const k of order) if (x.length === 0 || s.x[k] > x[x.length - 1]) { x.push(s.x[k]); y.push(s.y[k]); }
    return [x, y];
  }));

  const course = (holder, chart) => {
    const right = chart.right !== "";
    const options = {
      width: holder.clientWidth, height,
      scales: { x: { time: false }, y: {}, r: {} },
      axes: [{ label: chart.x }, { label: chart.y, size: 70 }],
      cursor: { drag: { x: true, y: false }, sync: chart.form === "time" ? { key: timeKey } : undefined },
      legend: { live: true },
      series: [{ label: chart.x, value: (u, v) => digits(v) }].concat(chart.series.map(s => ({
        label: s.name, scale: s.right ? "r" : "y", stroke: s.colour, width: 1.7, dash: dash(s),
        spanGaps: true, points: { show: false }, value: (u, v) => digits(v),
      }))),
      hooks: {},
    };
    if (right) options.axes.push({ scale: "r", side: 1, label: chart.right, size: 70, grid: { show: false } });
    if (chart.form === "time") options.hooks.setCursor = [u => {
      const at = u.cursor.idx;
      if (at != null) planes.forEach(plane => plane.mark(u.data[0][at]));
    }];
    plots.push([new uPlot(options, joined(chart.series), holder), holder]);
  };

  const draw = s => (u, index) => {
    uPlot.orient(u, index, (series, dataX, dataY, scaleX, scaleY, toX, toY, left, top, wide, high) => {
      const ctx = u.ctx, ratio = devicePixelRatio;
      ctx.save();
      ctx.beginPath(); ctx.rect(left, top, wide, high); ctx.clip();
      ctx.strokeStyle = ctx.fillStyle = series._stroke;
      ctx.lineWidth = 1.7 * ratio;
      ctx.setLineDash((dash(s) || []).map(d => d * ratio));
      ctx.beginPath();
      let pen = false;
      for (let k = 0; k < dataX.length; k++) {
        if (dataX[k] == null || dataY[k] == null) { pen = false; continue; }
        const x = toX(dataX[k], scaleX, wide, left), y = toY(dataY[k], scaleY, high, top);
        if (s.style === "dots") { ctx.moveTo(x + 1.6 * ratio, y); ctx.arc(x, y, 1.6 * ratio, 0, 2 * Math.PI); }
        else if (pen) ctx.lineTo(x, y); else ctx.moveTo(x, y);
        pen = true;
      }
      if (s.style === "dots") ctx.fill(); else ctx.stroke();
      ctx.restore();
    });
    return null;
  };

  const plane = (holder, chart) => {
    const extent = key => {
      let low = Infinity, high = -Infinity;
      for (const s of chart.series) for (const v of s[key]) if (v != null) { low = Math.min(low, v); high = Math.max(high, v); }
      const room = 0.05 * (high - low || 1);
      return [low - room, high + room];
    };
    const full = { x: extent("x"), y: extent("y") };
    const range = key => (u, low, high) => low == null || holder.dataset.zoomed !== "yes" ? full[key] : [low, high];
    const readout = document.createElement("p"), spot = document.createElement("i");
    readout.className = "readout"; spot.className = "spot";
    readout.textContent = "Point at a curve for its values; drag to zoom, double-click to reset.";
    const options = {
      mode: 2, width: holder.clientWidth, height: 420,
      scales: { x: { time: false, range: range("x") }, y: { range: range("y") } },
      axes: [{ label: chart.x }, { label: chart.y, size: 70 }],
      cursor: { drag: { x: true, y: true, setScale: false }, points: { show: false } },
      legend: { live: false },
      series: [{}].concat(chart.series.map(s => ({
        label: s.name, stroke: s.colour, paths: draw(s), _stroke: s.colour,
        facets: [{ scale: "x", auto: true }, { scale: "y", auto: true }],
      }))),
      hooks: {
        setSelect: [u => {
          const { left, top, width, height } = u.select;
          if (width < 5 || height < 5) return;
          holder.dataset.zoomed = "yes";
          const x = [u.posToVal(left, "x"), u.posToVal(left + width, "x")];
          const y = [u.posToVal(top + height, "y"), u.posToVal(top, "y")];
          u.batch(() => { u.setScale("x", { min: x[0], max: x[1] }); u.setScale("y", { min: y[0], max: y[1] }); });
          u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        }],
      },
    };
    const u = new uPlot(options, [null].concat(chart.series.map(s => [s.x, s.y])), holder);
    u.over.appendChild(spot);
    holder.after(readout);
    u.over.addEventListener("dblclick", () => {
      holder.dataset.zoomed = "no";
      u.batch(() => { u.setScale("x", { min: full.x[0], max: full.x[1] }); u.setScale("y", { min: full.y[0], max: full.y[1] }); });
    });
    const show = (x, y, text) => {
      spot.style.display = "block";
      spot.style.left = u.valToPos(x, "x") + "px"; spot.style.top = u.valToPos(y, "y") + "px";
      readout.textContent = text;
    };
    const values = (x, y) => `${chart.x} ${digits(x)}, ${chart.y} ${digits(y)}`;
    u.over.addEventListener("mousemove", event => {
      const box = u.over.getBoundingClientRect(), at = [event.clientX - box.left, event.clientY - box.top];
      let best = null, least = 30 * 30;
      chart.series.forEach((s, index) => {
        if (!u.series[index + 1].show) return;
        s.x.forEach((x, k) => {
          if (x == null || s.y[k] == null) return;
          const dx = u.valToPos(x, "x") - at[0], dy = u.valToPos(s.y[k], "y") - at[1], far = dx * dx + dy * dy;
          if (far < least) { least = far; best = [x, s.y[k], s.name, index, k]; }
        });
      });
      if (!best) return;
      const [x, y, name, index, k] = best;
      const when = chart.series[index].t ? `, at ${digits(chart.series[index].t[k])} s` : "";
      show(x, y, `${name}: ${values(x, y)}${when}`);
    });
    const duty = chart.series.find(s => s.t);
    planes.push({
      mark: time => {
        if (!duty) return;
        let low = 0, high = duty.t.length - 1;
        while (low < high) { const middle = (low + high) >> 1; if (duty.t[middle] < time) low = middle + 1; else high = middle; }
        show(duty.x[low], duty.y[low], `${duty.name}: ${values(duty.x[low], duty.y[low])}, at ${digits(time)} s`);
      },
    });
    plots.push([u, holder]);
  };

  for (const source of document.querySelectorAll("script.chart")) {
    const figure = source.closest("figure"), holder = document.createElement("div");
    holder.className = "live";
    figure.classList.add("drawn");
    figure.prepend(holder);
    const chart = JSON.parse(source.textContent);
    for (const s of chart.series) s.x = chart.places[s.at];
    if (chart.form === "plane") plane(holder, chart); else course(holder, chart);
  }
  addEventListener("resize", () => {
    for (const [plot, holder] of plots) plot.setSize({ width: holder.clientWidth, height: plot.height });
  });
})();
