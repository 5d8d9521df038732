// The chart of a quantity: curves against a load, or bars of all methods and settings if there is no load. Pure, as
// charts.js is.
const costChart = (() => {
    const { themes, digits, withUnit } = chartStyle;
    const { columnOf, axisTitle, shown, isWhole, valueOf, variantOf, worldOf, inOrder, distinct, loadsOf, quantitiesOf, opensOnCost } = chartData;
    const { seriesStyles, methodColour, fresh, setSignals, setData, setScale, panelsWithin, legendColumns, legendLines, domainOf, logTicks, setTicks, spans, intervalText, runsText, missing, rowsOf, widestText, tableOf, letterWidth } = chartParts;
    /// The choice of bars, one for each setting, in place of a load.
    const bars = 'bars';

    /// The key that groups the points of a line. Its prefix avoids names that every object has: Vega keeps groups as properties.
    const lineOf = series => `line ${series}`;
    const fitCurves = (experiment, x, column, theSeries, thePanel, min, max) => {
        const rows = [];
        const of = column === 'fps_avg' ? 'frame_ms_median' : column;
        for (const fit of experiment.fits.filter(item => item.axis === x && item.column === of)) {
            for (let step = 0; step <= 40; ++step) {
                const load = min > 0 ? min * (max / min) ** (step / 40) : min + (max - min) * step / 40;
                const ms = fit.a[0] + fit.b[0] * load ** fit.k[0];
                rows.push({ series: theSeries(fit), line: lineOf(theSeries(fit)), panel: thePanel(fit), x: load, y: column === 'fps_avg' ? 1000 / ms : ms });
            }
        }
        return rows;
    };

    /// The place of a value on an axis, from 0 to 1.
    const shareOf = (value, [low, high], log) => (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
    const numberFormat = ',.6~r';
    /// The format of an axis whose ticks are at these pixels: `2,000`, or `2k` where Vega would leave labels out for lack of space.
    const tickFormat = (ticks, places) => {
        const widths = ticks.map(tick => digits(tick, 6, true).length * letterWidth * 11);
        const isTight = places.some((place, index) => index > 0 && place - places[index - 1] < (widths[index - 1] + widths[index]) / 2 + 6);
        return isTight && ticks.every(tick => tick === 0 || Math.abs(tick) >= 1) ? '.6~s' : numberFormat;
    };

    /// Labels with their heights in pixels, pushed apart where they would overlap.
    const pushedApart = (unsorted, domain, log, height) => {
        const labels = unsorted.map(label => ({ ...label, pixel: height * (1 - shareOf(label.y, domain, log)) })).sort((a, b) => a.pixel - b.pixel);
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
    /// Texts at the right ends of the lines.
    const endLabels = (points, series, domain, log, height) => pushedApart(series.map(({ name }) => {
        const last = points.filter(point => point.series === name).sort((a, b) => b.x - a.x)[0];
        return { series: name, text: name, panel: '', y: last.y };
    }), domain, log, height);

    /// The quantity and load to show: the requested ones, else those that the suite names, else the frame rate over the first load.
    const choose = (report, chart) => {
        const { experiment } = chart;
        const opens = experiment.chart || {};
        const quantities = quantitiesOf(report, experiment);
        const opened = opensOnCost(experiment) ? opens.against : opens.column;
        const column = [chart.column, opened, 'fps_avg', quantities[0]].find(name => quantities.includes(name));
        const loads = loadsOf(experiment).filter(load => load.numeric);
        const named = [chart.x, opens.against].find(name => name === bars || loads.some(load => load.name === name));
        const x = named || (loads.length ? loads[0].name : bars);
        return { column, x, load: loads.find(load => load.name === x) };
    };
    const pointTip = (report, cell, title, column, load) => {
        const info = columnOf(report, column);
        return {
            title,
            ...(load ? { [load.name]: `${cell.settings[load.name]}${load.unit && load.unit !== load.name ? ' ' + load.unit : ''}` } : {}),
            [info.name]: withUnit(valueOf(cell, column)[0], info.unit),
            range: intervalText(cell, valueOf(cell, column), info.unit),
            runs: runsText(cell),
        };
    };

    const buildCurves = (report, chart, column, load) => {
        const { experiment, theme } = chart;
        const info = columnOf(report, column);
        const hasLoad = cell => cell.settings[load.name] !== undefined;
        const cells = inOrder(experiment, experiment.cells)
            .filter(cell => (hasLoad(cell) || cell.method !== chartStyle.baseline) && valueOf(cell, column) && !chart.hidden.has(cell.method));
        if (!cells.some(hasLoad)) return missing;
        const loads = distinct(cells.filter(hasLoad).map(cell => Number(cell.settings[load.name])));
        // The line of a configuration without the load is level.
        const atOf = cell => (hasLoad(cell) ? [Number(cell.settings[load.name])] : [Math.min(...loads), Math.max(...loads)]);

        // One method with one setting: its lines share a panel, a line for each world.
        const panels = distinct(cells.map(cell => worldOf(experiment, cell, load.name)));
        const alone = distinct(cells.map(cell => variantOf(report, experiment, cell, load.name))).length === 1 && panels.length > 1 && panels.length <= 7;
        const thePanel = cell => (alone ? '' : worldOf(experiment, cell, load.name));
        const theSeries = cell => (alone ? worldOf(experiment, cell, load.name) : variantOf(report, experiment, cell, load.name));
        const points = cells.flatMap(cell => {
            const [y, low, high] = valueOf(cell, column).map(value => shown(value, info.unit));
            const tip = pointTip(report, cell, theSeries(cell), column, hasLoad(cell) ? load : undefined);
            return atOf(cell).map(x => ({ panel: thePanel(cell), series: theSeries(cell), line: lineOf(theSeries(cell)), x, y, low, high, tip }));
        });
        const xs = distinct(points.map(point => point.x)).sort((a, b) => a - b);
        const xLog = chart.xLog ?? spans(xs, 15);
        const published = publishedMarks.along(report, experiment, column, load, cells, points, theSeries, thePanel);
        const isSolid = published.marks.length > 0;
        const bands = publishedMarks.bands(report, experiment, column, cells, item => methodColour(report, item.method, theme));
        const beside = [...published.marks, ...published.scaled].map(row => row.y).concat(bands.flatMap(band => [band.min, band.max]));
        const yLog = chart.yLog ?? spans(points.map(point => point.y).concat(beside), beside.length ? 10 : 60);
        const seen = points.filter(point => (!xLog || point.x > 0) && (!yLog || point.low > 0));
        if (!seen.length) return { empty: 'A logarithmic scale cannot show these values: none is above 0.' };
        const curves = xs.length > 1 ? fitCurves(experiment, load.name, column, theSeries, thePanel, xs[0], xs[xs.length - 1])
            .filter(row => seen.some(point => point.series === row.series && point.panel === row.panel)) : [];
        const series = distinct(seen.map(point => point.series))
            .map(name => ({ name, method: cells.find(cell => theSeries(cell) === name).method }));
        // Next to each other, so that intervals of equal loads do not hide each other.
        const gap = Math.min(5, 24 / series.length);
        for (const point of seen) point.shift = gap * (series.findIndex(({ name }) => name === point.series) - (series.length - 1) / 2);
        const styles = seriesStyles(report, series, theme);
        const shownPanels = distinct(seen.map(point => point.panel));
        const { columns, each } = panelsWithin(chart.width, shownPanels.length);
        const single = shownPanels.length === 1;
        const longest = Math.max(...series.map(({ name }) => name.length));
        const labelled = single && series.length > 1 && series.length <= 7 && chart.width > 520 && longest <= 34;
        const labelRoom = labelled ? Math.ceil(longest * 6.6 + 12) : 0;
        const panelWidth = Math.max(each - labelRoom, 120);
        const panelHeight = single ? 320 : Math.max(170, Math.min(240, Math.round(panelWidth * 0.75)));
        const yDomain = domainOf(seen.flatMap(point => [point.y, point.low, point.high]).concat(beside, published.marks.flatMap(mark => [mark.low, mark.high])), yLog, true);
        // Space for points that are shifted from their load.
        const edge = Math.max(0.04, (gap * (series.length - 1) / 2 + 8) / panelWidth);
        const xRoom = (xs[xs.length - 1] - xs[0]) * edge || 1, xFactor = (xs[xs.length - 1] / xs[0]) ** edge;

        const spec = fresh(report.specifications.cost);
        setSignals(spec, {
            panelWidth, panelHeight, panelColumns: columns, labelRoom, xTitle: axisTitle(load.name, load.unit === load.name ? '' : load.unit), yTitle: axisTitle(info.name, info.unit),
            xFormat: numberFormat, yFormat: yDomain[1] >= 1e6 ? '.4~s' : ',.6~r',
            yStep: isWhole(info.unit) ? 1 : 0, legendColumns: legendColumns(chart.width, longest, series.length),
        });
        setData(spec, 'panels', shownPanels.map(panel => ({ panel })));
        setData(spec, 'points', seen);
        setData(spec, 'curves', curves.filter(row => row.y >= yDomain[0] && row.y <= yDomain[1]));
        setData(spec, 'bands', bands);
        const shifted = row => ({ ...row, shift: seen.find(point => point.series === row.series)?.shift || 0 });
        setData(spec, 'published', published.marks.map(shifted));
        setData(spec, 'scaled', published.scaled.map(shifted));
        setData(spec, 'factors', shownPanels.flatMap(panel => pushedApart(published.factors.filter(row => row.panel === panel), yDomain, yLog, panelHeight)));
        setData(spec, 'labels', labelled ? endLabels(seen, series, yDomain, yLog, panelHeight) : []);
        const names = series.map(({ name }) => name);
        const xDomain = xLog ? [xs[0] / Math.max(1.12, xFactor), xs[xs.length - 1] * Math.max(1.08, xFactor)] : [xs[0] - xRoom, xs[xs.length - 1] + xRoom];
        setScale(spec, 'x', { type: xLog ? 'log' : 'linear', domain: xDomain });
        setScale(spec, 'y', { type: yLog ? 'log' : 'linear', domain: yDomain });
        setScale(spec, 'colour', { domain: names, range: styles.map(style => style.colour) });
        setScale(spec, 'legendText', { domain: names, range: legendLines(names, chart.width) });
        setScale(spec, 'shape', { domain: names, range: styles.map(style => style.shape) });
        setScale(spec, 'dash', { domain: names, range: styles.map(style => (isSolid ? [1, 0] : style.dash)) });
        if (yLog) setTicks(spec.marks[0].axes[0], logTicks(yDomain));
        if (labelled || series.length === 1) spec.legends = [];
        const ticks = distinct([...xs, ...published.marks.map(mark => mark.x)]).sort((a, b) => a - b);
        if (xs.length <= 10) {
            setTicks(spec.marks[0].axes[1], ticks);
            setSignals(spec, { xFormat: tickFormat(ticks, ticks.map(tick => panelWidth * shareOf(tick, xDomain, xLog))) });
        }
        const key = [];
        if (alone || series.length === 1) key.push(`Method: ${variantOf(report, experiment, cells[0], load.name)}.`);
        if (curves.length) key.push(`Wide pale lines: the fitted cost a + b·N^k${column === 'fps_avg' ? ' of the frame time, as a rate' : ''}.`);
        key.push(...publishedMarks.keyOf(published, bands));
        return { spec, notes: [], key, table: tableOf(report, experiment, cells, [column]), state: { x: load.name, column, xLog, yLog } };
    };

    const buildBars = (report, chart, column) => {
        const { experiment, theme } = chart;
        const info = columnOf(report, column);
        const cells = experiment.cells.filter(cell => valueOf(cell, column) && !chart.hidden.has(cell.method));
        if (!cells.length) return missing;
        const along = experiment.axes.find(axis => axis.world && axis.values.length <= 8)?.name || '';
        const { rows, worlds, world } = rowsOf(report, experiment, cells, chart.world, along);
        for (const row of rows) {
            if (row.header) continue;
            [row.value, row.low, row.high] = valueOf(row.cell, column).map(value => shown(value, info.unit));
            row.total = withUnit(valueOf(row.cell, column)[0], info.unit);
            row.colour = methodColour(report, row.cell.method, theme);
            row.tip = pointTip(report, row.cell, row.text, column);
        }
        const bands = publishedMarks.bands(report, experiment, column, cells, item => methodColour(report, item.method, theme));
        const values = rows.filter(row => !row.header).flatMap(row => [row.low, row.high]).concat(bands.map(band => band.max));
        const [least, most] = [Math.min(0, ...values), Math.max(0, ...values)];
        const spec = fresh(report.specifications.bars);
        spec.width = chart.width - 24;
        const room = widestText(rows) / Math.max(spec.width - widestText(rows), 60) * (most - least || 1);
        setSignals(spec, { xTitle: axisTitle(info.name, info.unit), xStep: isWhole(info.unit) ? 1 : 0, ink: themes[theme].ink, min: least, max: most + room });
        spec.height = rows.length * spec.signals.find(signal => signal.name === 'rowHeight').value;
        setData(spec, 'rows', rows.map(({ cell, ...row }) => row));
        setData(spec, 'bands', bands);
        const here = rows.filter(row => row.cell).map(row => row.cell);
        const key = publishedMarks.keyOf({ marks: [], factors: [] }, bands);
        return { spec, notes: [], key, table: tableOf(report, experiment, here, [column]), state: { x: bars, column, worlds, world } };
    };

    const build = (report, chart) => {
        const { column, x, load } = choose(report, chart);
        if (!column) return missing;
        return x === bars ? buildBars(report, chart, column) : buildCurves(report, chart, column, load);
    };
    return { build, bars, tickFormat };
})();
