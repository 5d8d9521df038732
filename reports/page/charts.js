// From the report's data to Vega specifications. Runs in a browser and in node, and uses no API of either.
//
// chartKit.list(data) names the charts; chartKit.build(report, chart) gives {spec, config, notes, table, state} or
// {empty: reason}. `report` is {data, columns, specifications}; `chart` is an entry of the list with any of
// {x, column, metric, against, part, world, run, xLog, yLog, hidden, width, theme} set over it. `table` is
// {columns: [[name, unit]…], rows}.
const chartKit = (() => {
    const { configOf, baseline, digits, themes, withUnit } = chartStyle;
    const { columnOf, valueOf, variantOf, worldOf, distinct, overSeeds, loadsOf, costsOf, metricsOf, quantitiesOf } = chartData;
    const { methodColour, fresh, setSignals, setData, setScale, domainOf, missing, wrapped } = chartParts;

    /// An experiment as charts and tables show it, with seeds combined.
    const shownOf = experiment => experiment.shown || (experiment.shown = overSeeds(experiment));

    const list = report => {
        const charts = [];
        for (const whole of report.data.experiments) {
            const experiment = shownOf(whole);
            if (!quantitiesOf(report, experiment).length) continue;
            if (experiment.cells.length > 1) charts.push({ id: experiment.id, kind: 'cost', experiment });
            if (experiment.cells.some(cell => valueOf(cell, 'frame_ms_median'))) charts.push({ id: experiment.id + '-stages', kind: 'stages', experiment });
            if (metricsOf(report, experiment).length && qualityChart.chargesOf(report, experiment).length) charts.push({ id: experiment.id + '-quality', kind: 'quality', experiment });
        }
        charts.push(...mapChart.listOf(report).map(map => ({ ...map, kind: 'map' })));
        if (report.data.frames.length) charts.push({ id: 'frames', kind: 'frames' });
        return charts;
    };

    const buildFrames = (report, chart) => {
        const frames = report.data.frames.filter(item => !chart.hidden.has(item.label.split(/[ ,]/)[0]));
        if (!frames.length) return missing;
        // Opens on the longest run of a method that draws something.
        const methodOf = item => item.label.split(/[ ,]/)[0];
        const drawing = frames.filter(item => methodOf(item) !== baseline);
        const longest = (drawing.length ? drawing : frames).reduce((most, item) => (item.frames > most.frames ? item : most));
        const run = frames.find(item => item.run === chart.run) || longest;
        const experiment = report.data.experiments.find(item => item.id === run.experiment);
        const trace = run.trace.map(([frame, ms]) => ({ frame, ms, tip: { title: `frame ${frame}`, time: withUnit(ms, 'ms') } }));
        const width = run.binMs || 0.1;
        const low = run.binMs ? run.minimumMs : run.minimumMs - 0.05;
        const bins = run.bins.map((count, index) => ({
            low: low + index * width, high: low + (index + 1) * width, count,
            tip: { title: `${withUnit(low + index * width, 'ms')} to ${withUnit(low + (index + 1) * width, 'ms')}`, frames: String(count) },
        }));
        let half = run.frames / 2;
        const median = (bins.find(bin => (half -= bin.count) <= 0) || bins[0]);
        const spec = fresh(report.specifications.frames);
        const narrow = chart.width < 620;
        const both = chart.width - 2 * 58 - 30;
        // Fewer frames are not a distribution.
        const isCounted = run.frames >= 10;
        setSignals(spec, {
            panelWidth: narrow || !isCounted ? chart.width - 66 : Math.round(both * 0.72), sideWidth: narrow ? chart.width - 66 : Math.round(both * 0.28),
            sideColumns: narrow ? 1 : 2, panelHeight: 220, colour: methodColour(report, methodOf(run), chart.theme),
            median: (median.low + median.high) / 2,
        });
        setData(spec, 'trace', trace);
        setData(spec, 'bins', bins);
        if (!isCounted) spec.marks.pop();
        setScale(spec, 'ms', { domain: domainOf([low, low + width * run.bins.length], false, false) });
        const thinned = run.trace.length < run.frames ? ` The trace shows the shortest and the longest frame of each stretch of the ${run.frames} frames.` : '';
        return {
            spec, notes: [`${words.labelText(run.label)}${experiment ? `; ${experiment.title}` : ''}. Dashed: the median.` + thinned], state: { run: run.run },
            table: { columns: [['frame', ''], ['frame_ms', 'ms']], rows: run.trace },
        };
    };

    const builders = { cost: costChart.build, stages: stageChart.build, quality: qualityChart.build, map: mapChart.build, frames: buildFrames };
    /// `AMD EPYC, 2 cores, llvmpipe`, of each machine.
    const devicesOf = (report, experiment) => {
        const machines = report.data.machines || [];
        const used = experiment ? distinct(experiment.cells.map(cell => cell.machine)) : machines.map((machine, index) => index);
        return used.filter(index => machines[index]).map(index => {
            const { cpu, cores, gl_renderer: renderer } = machines[index];
            const said = [cpu, cores && `${cores} cores`, renderer].filter(Boolean).join(', ') || 'an unknown device';
            return machines.length > 1 ? `machine ${index + 1}, ${said}` : said;
        });
    };
    const captionSize = 11;
    /// Adds the caption below the chart, so that every saved picture has it: the meaning of the marks, and the device.
    const withCaption = (report, asked, built) => {
        if (!built.spec) return built;
        const devices = devicesOf(report, asked.experiment);
        const lines = [...(built.key || []), ...(devices.length ? [`Measured on ${devices.join('; ')}.`] : [])];
        if (lines.length)
            built.spec.title = {
                text: lines.flatMap(line => wrapped(line, asked.width, captionSize)), orient: 'bottom', anchor: 'start', frame: 'bounds',
                offset: 12, fontSize: captionSize, fontWeight: 400, lineHeight: 15, color: themes[asked.theme].muted,
            };
        return { ...built, caption: lines };
    };
    const build = (report, chart) => {
        const asked = { width: 900, theme: 'light', hidden: new Set(), ...chart };
        return { config: configOf(asked.theme), ...withCaption(report, asked, builders[asked.kind](report, asked)) };
    };
    return { list, build, shownOf, loadsOf, costsOf, metricsOf, quantitiesOf, methodColour, digits, withUnit, columnOf, variantOf, worldOf };
})();
