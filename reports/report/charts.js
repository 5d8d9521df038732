// From the report's data to Vega specifications: the same in a browser and in node, and nothing of either is used.
//
// chartKit.list(data) names the charts; chartKit.build(report, chart) gives {spec, config, notes} or {empty: reason}.
// `report` is {data, columns, specifications}; `chart` is an entry of the list with any of
// {x, column, metric, against, world, run, xLog, yLog, hidden, width, theme} set over it.
const chartKit = (() => {
    const { methodColours, stages, stageColours, themes, shapes, dashes, configOf, fourDigits, withUnit, mixed } = chartStyle;
    const { columnOf, axisTitle, shown, valueOf, variantOf, worldOf, inOrder, distinct, loadsOf, costsOf, metricsOf } = chartData;

    // Colours: a method's own, darker (lighter on black) from one of its variants to the next; shapes and dashes as well.
    const methodColour = (report, method, theme) => {
        const known = report.data.methods.map(item => item.id);
        const all = distinct([...known, ...report.data.experiments.flatMap(item => item.cells.map(cell => cell.method)).sort()]);
        const colours = methodColours[theme];
        return colours[Math.max(all.indexOf(method), 0) % colours.length];
    };
    const seriesStyles = (report, series, theme) => {
        const perMethod = {};
        for (const { method } of series) perMethod[method] = (perMethod[method] || 0) + 1;
        const counted = {};
        return series.map(({ method }) => {
            const index = counted[method] = (counted[method] ?? -1) + 1;
            const share = perMethod[method] > 1 ? 0.55 * index / (perMethod[method] - 1) : 0;
            return {
                colour: mixed(methodColour(report, method, theme), themes[theme].ink, share),
                shape: shapes[index % shapes.length],
                dash: dashes[index % dashes.length],
            };
        });
    };

    const fresh = specification => JSON.parse(JSON.stringify(specification));
    const setSignals = (spec, values) => {
        for (const signal of spec.signals) if (signal.name in values) signal.value = values[signal.name];
    };
    const setData = (spec, name, values) => { spec.data.find(item => item.name === name).values = values; };
    const setScale = (spec, name, values) => Object.assign(spec.scales.find(item => item.name === name), values);
    const panelsWithin = (width, panels) => {
        const columns = panels === 1 || width < 620 ? 1 : panels === 2 || panels === 4 || width < 900 ? 2 : 3;
        return { columns, each: Math.floor((width - 8 - (columns - 1) * 26) / columns - 62) };
    };
    const legendColumns = (width, longest) => Math.max(Math.floor(width / (longest * 7.2 + 46)), 1);
    const domainOf = (values, log, zero) => {
        const finite = values.filter(value => Number.isFinite(value) && (!log || value > 0));
        if (!finite.length) return [log ? 1 : 0, 10];
        let [min, max] = [Math.min(...finite), Math.max(...finite)];
        if (log) return [min / 1.2, max * 1.2];
        const room = (max - min) * 0.06 || Math.abs(max) * 0.1 || 1;
        return [zero && min >= 0 ? 0 : min - room, max + room];
    };
    const spans = (values, factor) => {
        const above = values.filter(value => value > 0);
        return above.length === values.length && Math.max(...above) / Math.min(...above) >= factor;
    };
    const intervalText = (cell, [, low, high], unit) => {
        if (cell.runs.length < 2) return 'one run';
        const share = cell.probability >= 0.95 ? `, ${Math.floor(cell.probability * 100)} % interval of the median` : ', min and max';
        return `${fourDigits(shown(low, unit))} to ${fourDigits(shown(high, unit))}${share}`;
    };

    const list = report => {
        const charts = [];
        for (const experiment of report.data.experiments) {
            if (!experiment.cells.some(cell => valueOf(cell, 'frame_ms_median'))) continue;
            if (loadsOf(experiment).length) charts.push({ id: experiment.id, kind: 'cost', experiment });
            charts.push({ id: experiment.id + '-stages', kind: 'stages', experiment });
            if (metricsOf(report, experiment).length) charts.push({ id: experiment.id + '-quality', kind: 'quality', experiment });
        }
        if (report.data.frames.length) charts.push({ id: 'frames', kind: 'frames' });
        return charts;
    };

    const fitCurves = (report, experiment, x, column, theSeries, thePanel, min, max) => {
        const rows = [];
        const of = column === 'fps_avg' ? 'frame_ms_median' : column;
        for (const fit of experiment.fits.filter(item => item.axis === x && item.column === of)) {
            const cell = { ...fit, settings: fit.settings };
            for (let step = 0; step <= 40; ++step) {
                const load = min > 0 ? min * (max / min) ** (step / 40) : min + (max - min) * step / 40;
                const ms = fit.a[0] + fit.b[0] * load ** fit.k[0];
                rows.push({ series: theSeries(cell), panel: thePanel(cell), x: load, y: column === 'fps_avg' ? 1000 / ms : ms });
            }
        }
        return rows;
    };

    /// Texts at the right ends of the lines, pushed apart where they would overlap.
    const endLabels = (points, series, domain, log, height) => {
        const share = value => (log ? Math.log(value / domain[0]) / Math.log(domain[1] / domain[0]) : (value - domain[0]) / (domain[1] - domain[0]));
        const labels = series.map(({ name }) => {
            const last = points.filter(point => point.series === name).sort((a, b) => b.x - a.x)[0];
            return { series: name, text: name, panel: '', pixel: height * (1 - share(last.y)) };
        }).sort((a, b) => a.pixel - b.pixel);
        const gap = 14;
        for (let round = 0; round < 60; ++round)
            for (let index = 1; index < labels.length; ++index) {
                const overlap = gap - (labels[index].pixel - labels[index - 1].pixel);
                if (overlap <= 0) continue;
                labels[index - 1].pixel -= overlap / 2;
                labels[index].pixel += overlap / 2;
            }
        return labels;
    };

    const buildCost = (report, chart) => {
        const { experiment, theme } = chart;
        const load = experiment.axes.find(axis => axis.name === chart.x) || loadsOf(experiment)[0];
        const column = chart.column || 'fps_avg';
        const info = columnOf(report, column);
        const named = !load.numeric;
        let cells = inOrder(experiment, experiment.cells)
            .filter(cell => cell.settings[load.name] !== undefined && valueOf(cell, column) && !chart.hidden.has(cell.method));
        if (!cells.length) return { empty: 'No method that is switched on has these numbers.' };

        // One method in one setting: its lines share a panel, one for each world.
        const panels = distinct(cells.map(cell => worldOf(experiment, cell, load.name)));
        const alone = distinct(cells.map(cell => variantOf(report, experiment, cell, load.name))).length === 1 && panels.length > 1 && panels.length <= 7;
        const thePanel = cell => (alone ? '' : worldOf(experiment, cell, load.name));
        const theSeries = cell => (alone ? worldOf(experiment, cell, load.name) : variantOf(report, experiment, cell, load.name));
        const points = cells.map(cell => {
            const [y, low, high] = valueOf(cell, column).map(value => shown(value, info.unit));
            const x = named ? cell.settings[load.name] : Number(cell.settings[load.name]);
            return {
                panel: thePanel(cell), series: theSeries(cell), x, y, low, high,
                tip: {
                    title: theSeries(cell),
                    [load.name]: named ? x : `${fourDigits(x)}${load.unit ? ' ' + load.unit : ''}`,
                    [info.name]: withUnit(valueOf(cell, column)[0], info.unit),
                    'from … to': intervalText(cell, valueOf(cell, column), info.unit),
                    runs: String(cell.runs.length),
                },
            };
        });
        const xs = distinct(points.map(point => point.x)).sort((a, b) => (named ? load.values.indexOf(a) - load.values.indexOf(b) : a - b));
        const xLog = !named && (chart.xLog ?? spans(xs, 15));
        const yLog = chart.yLog ?? spans(points.map(point => point.y), 60);
        const seen = points.filter(point => (!xLog || point.x > 0) && (!yLog || point.low > 0));
        if (!seen.length) return { empty: 'No value is above 0; a logarithmic scale cannot show it.' };
        const curves = !named && xs.length > 1 ? fitCurves(report, experiment, load.name, column, theSeries, thePanel, xs[0], xs[xs.length - 1])
            .filter(row => seen.some(point => point.series === row.series && point.panel === row.panel)) : [];
        const published = experiment.published.filter(item => item.column === column && (!item.axis || (!named && item.axis === load.name)))
            .map(item => ({
                x: item.axis ? item.x : null, min: item.min, max: item.max,
                tip: { title: 'published', [info.name]: `${fourDigits(item.min)} to ${fourDigits(item.max)} ${info.unit}`, of: item.what },
            }));
        const series = distinct(seen.map(point => point.series))
            .map(name => ({ name, method: cells.find(cell => theSeries(cell) === name).method }));
        // Side by side, so that intervals of equal loads do not hide each other.
        const gap = Math.min(5, 24 / series.length);
        for (const point of seen) point.shift = gap * (series.findIndex(({ name }) => name === point.series) - (series.length - 1) / 2);
        const styles = seriesStyles(report, series, theme);
        const shownPanels = distinct(seen.map(point => point.panel));
        const { columns, each } = panelsWithin(chart.width, shownPanels.length);
        const single = shownPanels.length === 1;
        const longest = Math.max(...series.map(({ name }) => name.length));
        const labelled = single && !named && series.length > 1 && series.length <= 7 && chart.width > 520 && longest <= 34;
        const labelRoom = labelled ? Math.ceil(longest * 6.6 + 12) : 0;
        const panelWidth = Math.max(Math.min(single ? 760 : each, each - labelRoom), 120);
        const panelHeight = single ? 300 : Math.max(170, Math.min(240, Math.round(panelWidth * 0.75)));
        const yDomain = domainOf(seen.flatMap(point => [point.y, point.low, point.high]).concat(published.flatMap(item => [item.min, item.max])), yLog, true);
        const xRoom = (xs[xs.length - 1] - xs[0]) * 0.04 || 1;

        const spec = fresh(report.specifications.cost);
        setSignals(spec, {
            panelWidth, panelHeight, panelColumns: columns, labelRoom, xTitle: axisTitle(load.name, load.unit), yTitle: axisTitle(info.name, info.unit),
            xFormat: xs[xs.length - 1] >= 100000 ? '.4~s' : ',.6~r', yFormat: yDomain[1] >= 100000 ? '.4~s' : ',.6~r',
            legendColumns: legendColumns(chart.width, longest),
        });
        setData(spec, 'panels', shownPanels.map(panel => ({ panel })));
        setData(spec, 'points', seen);
        setData(spec, 'curves', curves.filter(row => row.y >= yDomain[0] && row.y <= yDomain[1]));
        setData(spec, 'published', published);
        setData(spec, 'labels', labelled ? endLabels(seen, series, yDomain, yLog, panelHeight) : []);
        const names = series.map(({ name }) => name);
        if (named) {
            setScale(spec, 'x', { type: 'point', domain: xs, padding: 0.5 });
            delete spec.marks[0].axes[1].format;
            setSignals(spec, { lineWidth: 0 });
        } else setScale(spec, 'x', xLog ? { type: 'log', domain: [xs[0] / 1.12, xs[xs.length - 1] * 1.08] } : { type: 'linear', domain: [xs[0] - xRoom, xs[xs.length - 1] + xRoom] });
        setScale(spec, 'y', { type: yLog ? 'log' : 'linear', domain: yDomain });
        setScale(spec, 'colour', { domain: names, range: styles.map(style => style.colour) });
        setScale(spec, 'shape', { domain: names, range: styles.map(style => style.shape) });
        setScale(spec, 'dash', { domain: names, range: styles.map(style => style.dash) });
        if (labelled) spec.legends = [];
        if (!named && xs.length <= 10) spec.marks[0].axes[1].values = xs;
        const notes = [];
        if (published.length) notes.push(`Grey: numbers given in the paper's text. ${distinct(published.map(item => item.tip.of)).join('; ')}.`);
        if (curves.length) notes.push(`Wide pale lines: the fitted cost a + b·N^k${column === 'fps_avg' ? ' of the frame time, as a rate' : ''}.`);
        return { spec, notes, state: { x: load.name, column, xLog, yLog } };
    };

    const buildStages = (report, chart) => {
        const { experiment, theme } = chart;
        const mostRows = 16;
        const all = inOrder(experiment, experiment.cells).filter(cell => valueOf(cell, 'frame_ms_median') && !chart.hidden.has(cell.method));
        if (!all.length) return { empty: 'No method that is switched on has these numbers.' };
        const load = loadsOf(experiment)[0];
        // Where there are too many, those that share the rest of the world.
        const along = all.length > mostRows && load && load.world && load.values.length <= 8 ? load.name : '';
        const rest = cell => worldOf(experiment, cell, along);
        const worlds = all.length > mostRows ? distinct(all.map(rest)) : [];
        const world = worlds.includes(chart.world) ? chart.world : worlds[worlds.length - 1];
        const cells = worlds.length > 1 ? all.filter(cell => rest(cell) === world) : all;
        const severalWorlds = distinct(cells.map(cell => worldOf(experiment, cell))).length > 1;
        const severalVariants = distinct(cells.map(cell => variantOf(report, experiment, cell))).length > 1;
        const bars = [], rows = [], used = new Set();
        let lastWorld = null;
        for (const cell of cells) {
            const here = worldOf(experiment, cell);
            if (severalWorlds && severalVariants && here !== lastWorld) rows.push({ place: rows.length, text: here, header: true, ms: 0, total: '' });
            lastWorld = here;
            const text = severalVariants || !severalWorlds ? variantOf(report, experiment, cell) : here;
            const place = rows.length;
            let sum = 0;
            stages.forEach((stage, order) => {
                const value = valueOf(cell, stage + '_ms_median');
                if (!value) return;
                used.add(stage);
                sum += value[0];
                bars.push({ place, stage, order, ms: value[0], whole: valueOf(cell, 'frame_ms_median')[0], text });
            });
            rows.push({ place, text, header: false, ms: sum, total: `${fourDigits(sum)} ms` });
        }
        if (!bars.length) return { empty: 'The stages of these runs are not recorded.' };
        for (const bar of bars)
            bar.tip = { title: bar.text, [bar.stage]: `${fourDigits(bar.ms)} ms`, frame: `${fourDigits(bar.whole)} ms`, share: `${fourDigits(100 * bar.ms / bar.whole)} %` };
        const spec = fresh(report.specifications.stages);
        setSignals(spec, {
            xTitle: 'medians of the stages [ms]', ink: themes[theme].ink,
            legendColumns: Math.max(Math.floor(chart.width / 92), 2), max: Math.max(...rows.map(row => row.ms)) * (1 + 70 / chart.width),
        });
        spec.width = chart.width - 24;
        spec.height = rows.length * spec.signals.find(signal => signal.name === 'rowHeight').value;
        setData(spec, 'rows', rows);
        setData(spec, 'stages', bars);
        const order = stages.filter(stage => used.has(stage));
        setScale(spec, 'stage', { domain: order, range: order.map(stage => stageColours[theme][stages.indexOf(stage)]) });
        return { spec, notes: [], state: { worlds: worlds.length > 1 ? worlds : [], world } };
    };

    const buildQuality = (report, chart) => {
        const { experiment, theme } = chart;
        const metrics = metricsOf(report, experiment);
        const metric = metrics.includes(chart.metric) ? chart.metric : metrics.includes('flip') ? 'flip' : metrics[0];
        const against = chart.against || 'frame_ms_median';
        const [info, cost] = [columnOf(report, metric), columnOf(report, against)];
        const cells = inOrder(experiment, experiment.cells)
            .filter(cell => valueOf(cell, metric) && valueOf(cell, against) && !chart.hidden.has(cell.method));
        if (!cells.length) return { empty: 'No method that is switched on has these numbers.' };
        const points = cells.map(cell => ({
            panel: worldOf(experiment, cell), series: variantOf(report, experiment, cell), method: cell.method,
            x: shown(valueOf(cell, against)[0], cost.unit), y: valueOf(cell, metric)[0],
            tip: {
                title: variantOf(report, experiment, cell),
                [info.name]: withUnit(valueOf(cell, metric)[0], info.unit),
                [cost.name]: withUnit(valueOf(cell, against)[0], cost.unit),
            },
        }));
        const panels = distinct(points.map(point => point.panel));
        const better = (a, b) => (info.better === 'high' ? a > b : a < b);
        const front = panels.flatMap(panel => {
            let best = null;
            return points.filter(point => point.panel === panel)
                .sort((a, b) => a.x - b.x || (better(a.y, b.y) ? -1 : 1))
                .filter(point => {
                    if (best !== null && !better(point.y, best)) return false;
                    best = point.y;
                    return true;
                });
        });
        const xLog = chart.xLog ?? spans(points.map(point => point.x), 8);
        const yLog = (chart.yLog ?? false) && points.every(point => point.y > 0);
        const series = distinct(points.map(point => point.series)).map(name => ({ name, method: points.find(point => point.series === name).method }));
        const styles = seriesStyles(report, series, theme);
        const { columns, each } = panelsWithin(chart.width, panels.length);
        const panelWidth = Math.max(panels.length === 1 ? Math.min(each, 640) : each, 120);
        const spec = fresh(report.specifications.quality);
        setSignals(spec, {
            panelWidth, panelHeight: panels.length === 1 ? 300 : 240, panelColumns: columns, xTitle: axisTitle(cost.name, cost.unit),
            yTitle: axisTitle(info.name, info.unit), xFormat: ',.6~r', yFormat: ',.6~r', frontColour: themes[theme].muted,
            legendColumns: legendColumns(chart.width, Math.max(...series.map(({ name }) => name.length))),
        });
        setData(spec, 'panels', panels.map(panel => ({ panel })));
        setData(spec, 'points', points);
        setData(spec, 'front', front);
        setScale(spec, 'x', { type: xLog ? 'log' : 'linear', domain: domainOf(points.map(point => point.x), xLog, false) });
        setScale(spec, 'y', { type: yLog ? 'log' : 'linear', domain: domainOf(points.map(point => point.y), yLog, info.better === 'low') });
        const names = series.map(({ name }) => name);
        setScale(spec, 'colour', { domain: names, range: styles.map(style => style.colour) });
        setScale(spec, 'shape', { domain: names, range: styles.map(style => style.shape) });
        const hint = info.better === 'high' ? 'upwards and to the left is better' : 'downwards and to the left is better';
        return { spec, notes: [`${hint[0].toUpperCase()}${hint.slice(1)}. Ringed and joined: the Pareto front, what nothing else here beats in both.`], state: { metric, against, xLog, yLog } };
    };

    const buildFrames = (report, chart) => {
        const frames = report.data.frames.filter(item => !chart.hidden.has(item.label.split(/[ ,]/)[0]));
        if (!frames.length) return { empty: 'No method that is switched on has these numbers.' };
        const run = frames.find(item => item.run === chart.run) || frames[0];
        const trace = run.trace.map(([frame, ms]) => ({ frame, ms, tip: { title: `frame ${frame}`, time: `${fourDigits(ms)} ms` } }));
        const width = run.binMs || 0.1;
        const low = run.binMs ? run.minimumMs : run.minimumMs - 0.05;
        const bins = run.bins.map((count, index) => ({
            low: low + index * width, high: low + (index + 1) * width, count,
            tip: { title: `${fourDigits(low + index * width)} to ${fourDigits(low + (index + 1) * width)} ms`, frames: String(count) },
        }));
        let half = run.frames / 2;
        const median = (bins.find(bin => (half -= bin.count) <= 0) || bins[0]);
        const spec = fresh(report.specifications.frames);
        const narrow = chart.width < 620;
        const both = chart.width - 2 * 58 - 30;
        setSignals(spec, {
            panelWidth: narrow ? chart.width - 66 : Math.round(both * 0.72), sideWidth: narrow ? chart.width - 66 : Math.round(both * 0.28),
            sideColumns: narrow ? 1 : 2, panelHeight: 220, colour: methodColour(report, run.label.split(/[ ,]/)[0], chart.theme),
            median: (median.low + median.high) / 2,
        });
        setData(spec, 'trace', trace);
        setData(spec, 'bins', bins);
        setScale(spec, 'ms', { domain: domainOf([low, low + width * run.bins.length], false, false) });
        const thinned = run.trace.length < run.frames ? ` Of ${run.frames} frames the trace shows the shortest and the longest of each stretch.` : '';
        return { spec, notes: ['Dashed: the median.' + thinned], state: { run: run.run } };
    };

    const builders = { cost: buildCost, stages: buildStages, quality: buildQuality, frames: buildFrames };
    const build = (report, chart) => {
        const asked = { width: 900, theme: 'light', hidden: new Set(), ...chart };
        return { config: configOf(asked.theme), ...builders[asked.kind](report, asked) };
    };
    return { list, build, loadsOf, costsOf, metricsOf, methodColour, fourDigits, withUnit, columnOf, variantOf, worldOf };
})();
