// The chart of the stages of a frame: those of the method, or all of them. Pure, as charts.js is.
const stageChart = (() => {
    const { stages, stageColours, themes, withUnit } = chartStyle;
    const { valueOf, distinct, loadsOf } = chartData;
    const { fresh, setSignals, setData, setScale, missing, rowsOf, widestText, tableOf } = chartParts;
    /// Stages of the world and the harness, which all methods share.
    const shared = ['input', 'scene', 'wait'];

    /// How the stages were timed, which decides what their times mean.
    const timingOf = (report, experiment, cells) => {
        const kinds = distinct(cells.map(cell => cell.settings.sync || (experiment.common || {}).sync).filter(Boolean));
        const isSoftware = report.data.machines.some(machine => /llvmpipe|softpipe|swrast|swiftshader/i.test(machine.gl_renderer || ''));
        if (!kinds.length) return '';
        if (kinds.includes('stage')) return 'Timed with --sync stage: each stage ends when its GPU work is finished.';
        const waits = isSoftware ? 'the software renderer does part of the drawing only then' : 'a GPU draws only then';
        const timer = cells.some(cell => valueOf(cell, 'gpu_ms_median')) ? ' GPU timers measure all GPU work; the tooltip shows the GPU time.' : '';
        return `Timed with --sync ${kinds.join(', ')}, by the wall clock of the CPU. Queued work counts towards the wait at the end of the frame (${waits}), not towards its stage; --sync stage counts it towards its stage.${timer}`;
    };

    const build = (report, chart) => {
        const { experiment, theme } = chart;
        const own = chart.part !== 'frame';
        const shownStages = own ? stages.filter(stage => !shared.includes(stage)) : stages;
        const load = loadsOf(experiment)[0];
        const cells = experiment.cells.filter(cell => valueOf(cell, 'frame_ms_median') && !chart.hidden.has(cell.method));
        if (!cells.length) return missing;
        const along = load && load.world && load.values.length <= 8 ? load.name : '';
        const { rows, worlds, world } = rowsOf(report, experiment, cells, chart.world, along);
        const pieces = [], used = new Set();
        for (const row of rows) {
            if (row.header) continue;
            const methodMs = (valueOf(row.cell, 'method_ms_median') || [null])[0], frameMs = valueOf(row.cell, 'frame_ms_median')[0];
            const gpuMs = valueOf(row.cell, 'gpu_ms_median');
            row.ms = 0;
            shownStages.forEach((stage, order) => {
                const value = valueOf(row.cell, stage + '_ms_median');
                if (!value) return;
                used.add(stage);
                row.ms += value[0];
                pieces.push({
                    place: row.place, stage, order, ms: value[0],
                    tip: {
                        title: row.text, [stage]: withUnit(value[0], 'ms'), frame: withUnit(frameMs, 'ms'), 'share of the frame': withUnit(value[0] / frameMs, 'share'),
                        ...(gpuMs ? { 'GPU time': withUnit(gpuMs[0], 'ms') } : {}),
                    },
                });
            });
            row.own = own ? methodMs : null;
            row.end = Math.max(row.ms, row.own || 0);
            row.total = withUnit(row.ms, 'ms') + (row.own !== null ? `, method ${withUnit(row.own, 'ms')}` : '');
        }
        if (!pieces.length) return { empty: 'These runs have no recorded stages.' };
        const spec = fresh(report.specifications.stages);
        spec.width = chart.width - 24;
        const lengths = rows.filter(row => !row.header);
        const most = Math.max(...lengths.map(row => row.end)), least = Math.min(0, ...lengths.map(row => row.own || 0));
        const room = widestText(rows) / Math.max(spec.width - widestText(rows), 60) * (most - least || 1);
        setSignals(spec, {
            xTitle: `${own ? 'stages of the method' : 'stages of the frame'}, medians [ms]`, ink: themes[theme].ink,
            legendColumns: Math.max(Math.floor(chart.width / 92), 2), min: least, max: most + room,
        });
        spec.height = rows.length * spec.signals.find(signal => signal.name === 'rowHeight').value;
        setData(spec, 'rows', rows.map(({ cell, ...row }) => row));
        setData(spec, 'stages', pieces);
        const order = shownStages.filter(stage => used.has(stage));
        setScale(spec, 'stage', { domain: order, range: order.map(stage => stageColours[theme][stages.indexOf(stage)]) });
        const here = rows.filter(row => row.cell).map(row => row.cell);
        const notes = [timingOf(report, experiment, here)];
        if (own && lengths.some(row => row.own !== null)) notes.push('Line: method_ms_median, the frame time minus that of the null method in the same world, which includes a draw and a wait as well.');
        else if (own) notes.push('method_ms_median is unknown, because the null method was not run in these worlds.');
        return {
            spec, notes: notes.filter(Boolean), table: tableOf(report, experiment, here, ['frame_ms_median', 'method_ms_median', ...stages.map(stage => stage + '_ms_median')]),
            state: { worlds, world, part: own ? 'own' : 'frame' },
        };
    };
    return { build };
})();
