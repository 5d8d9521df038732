// Builds the page from the data in it.
//
// The data (bench/report/report_json.cpp): folder, written, version; problems; machines, methods and papers; runs, the ids
// that all others count; experiments with axes, cells, fits and published numbers; claims; frames, the frame times of
// some runs; pictures by world and frame; notDone; warnings.
(() => {
    const read = id => JSON.parse(document.getElementById(id).textContent);
    const report = { data: read('report-data'), columns: read('report-columns'), specifications: read('report-charts') };
    const { data } = report;

    const { element, put, paragraph, plural, table } = pageKit;
    const section = name => document.getElementById(name);
    const runLinks = (indices, text) => {
        const most = 200;
        const list = element('ul', {}, indices.slice(0, most).map(index => element('li', {}, [element('a', {
            href: `runs/${encodeURIComponent(data.runs[index])}/run.json`, textContent: data.runs[index],
        })])));
        if (indices.length > most) put(list, element('li', { textContent: `and ${indices.length - most} more` }));
        return element('details', {}, [element('summary', { textContent: text }), list]);
    };
    const experimentOf = id => data.experiments.find(item => item.id === id);
    const isQuick = experiment => experiment.suite && experiment.id !== experiment.suite;
    const shortTitle = experiment => experiment.title.split(':')[0] + (isQuick(experiment) ? ' (quick)' : '');
    const titleOf = experiment => experiment.title + (isQuick(experiment) ? ' (quick)' : '');

    // Theme and methods, which all charts follow.
    const asked = window.matchMedia('(prefers-color-scheme: dark)');
    let theme = asked.matches ? 'dark' : 'light';
    const hidden = new Set();
    const charts = [];
    const drawAll = () => Promise.all(charts.map(chart => chart.draw()));
    const showTheme = () => {
        document.documentElement.dataset.theme = theme;
        section('theme').textContent = theme === 'dark' ? 'Light' : 'Dark';
        for (const chip of section('methods').children)
            chip.style.setProperty('--colour', chartKit.methodColour(report, chip.dataset.method, theme));
    };
    const setTheme = next => {
        theme = next;
        showTheme();
        return drawAll();
    };

    // What a point says under the pointer.
    const tooltip = section('tooltip');
    const showTooltip = (handler, event, item, value) => {
        tooltip.hidden = !value;
        if (!value) return;
        const { title, ...rows } = value;
        tooltip.replaceChildren(element('b', { textContent: title }), ...Object.entries(rows).map(([name, text]) =>
            element('div', {}, [element('span', { textContent: name }), element('span', { textContent: text })])));
        const room = 14;
        const left = Math.min(event.clientX + room, window.innerWidth - tooltip.offsetWidth - 6);
        const below = event.clientY + room + tooltip.offsetHeight < window.innerHeight;
        tooltip.style.left = `${Math.max(left, 6)}px`;
        tooltip.style.top = `${below ? event.clientY + room : event.clientY - room - tooltip.offsetHeight}px`;
    };

    /// A chart with its controls; each of these is [key, label, [[value, text]…]] and sets that key of the chart.
    const addChart = (parent, chart, controls = []) => {
        const settings = {};
        const place = element('div', { className: 'chart', id: `chart-${chart.id}` });
        const note = paragraph('', 'note');
        const bar = element('div', { className: 'controls' });
        let view = null, drawnOnce = Promise.resolve();
        const drawing = async () => {
            if (view) view.finalize();
            view = null;
            const width = Math.max(Math.floor(place.clientWidth), 260);
            const { spec, config, notes, empty, state } = chartKit.build(report, { ...chart, ...settings, width, theme, hidden });
            place.replaceChildren();
            note.textContent = empty ? '' : notes.join(' ');
            if (empty) {
                put(place, paragraph(empty, 'empty'));
                return;
            }
            for (const select of bar.querySelectorAll('select'))
                if (state && state[select.dataset.key] !== undefined) select.value = String(state[select.dataset.key]);
            view = new vega.View(vega.parse(spec, config, { ast: true }), {
                renderer: 'svg', container: place, hover: true, expr: vega.expressionInterpreter, tooltip: showTooltip, logLevel: vega.Warn,
            });
            await view.runAsync();
            place.querySelector('svg')?.setAttribute('aria-label', `${chart.id}: ${spec.description}`);
        };
        // One after the other, so that a late one never lies over the newest.
        const draw = () => (drawnOnce = drawnOnce.then(drawing));
        for (const [key, label, options] of controls) {
            if (options.length < 2) continue;
            const select = element('select', { dataset: { key } }, options.map(([value, text]) => new Option(text, value)));
            select.addEventListener('change', () => {
                settings[key] = select.value === 'true' ? true : select.value === 'false' ? false : key === 'run' ? Number(select.value) : select.value;
                // Another quantity has a scale of its own.
                if (['x', 'column'].includes(key)) delete settings[key === 'x' ? 'xLog' : 'yLog'];
                if (key === 'metric') delete settings.yLog;
                if (key === 'against') delete settings.xLog;
                draw();
            });
            put(bar, element('label', { className: 'control' }, [element('span', { textContent: label }), select]));
        }
        const download = (url, ending) => element('a', { href: url, download: `${chart.id}.${ending}` }).click();
        const save = async ending => {
            if (!view) return;
            if (ending === 'png') return download(await view.toImageURL('png', 2), ending);
            const url = URL.createObjectURL(new Blob([await view.toSVG()], { type: 'image/svg+xml' }));
            download(url, ending);
            setTimeout(() => URL.revokeObjectURL(url), 10000);
        };
        put(bar, element('span', { className: 'save' }, ['svg', 'png'].map(ending => {
            const button = element('button', { type: 'button', textContent: ending.toUpperCase(), title: `save this chart as ${ending.toUpperCase()}`, className: `save-${ending}` });
            button.addEventListener('click', () => save(ending));
            return button;
        })));
        put(parent, bar, place, note);
        charts.push({ draw, place });
    };
    const columnOptions = names => names.map(name => [name, report.columns[name].name]);
    const scales = [['false', 'linear'], ['true', 'logarithmic']];

    const fitTable = experiment => {
        const estimate = ([value, plusMinus]) => chartKit.fourDigits(value) + (plusMinus === null ? '' : ` ± ${chartKit.fourDigits(plusMinus)}`);
        const rows = experiment.fits.map(fit => [
            `${chartKit.variantOf(report, experiment, fit, fit.axis)}${fit.settings ? ', ' + chartKit.worldOf(experiment, fit, fit.axis) : ''}`.replace(/, $/, ''),
            report.columns[fit.column].name, fit.axis, estimate(fit.a), estimate(fit.b), estimate(fit.k), `${fit.loads}, ${fit.runs}`,
        ]);
        return element('details', {}, [
            element('summary', { textContent: `Fitted costs: ms = a + b·N^k (${plural(rows.length, 'curve')})` }),
            table([['of'], ['cost'], ['N'], ['a [ms]', 'number'], ['b', 'number'], ['k', 'number'], ['loads, runs', 'number']], rows),
        ]);
    };
    const shapeNote = experiment => {
        // Our own views of a paper's methods have nothing to be held against.
        if (experiment.published.length || !experiment.title.startsWith('Figure')) return null;
        return paragraph('Compare the shape only: the paper\'s text gives no numbers for this chart.', 'note shape-note');
    };

    const addPerformance = () => {
        const here = section('performance');
        const known = chartKit.list(report);
        if (!known.length) put(here, paragraph('No run has frame times.', 'muted'));
        else put(here, paragraph('Each point is the median of a cell\'s runs. The bar is the interval that contains the true median with at least 95 % probability, from ' +
            'the order of 6 or more runs; with fewer runs it spans the minimum and maximum. Points with the same load are drawn slightly apart. Runs alternate in random order, each in its own process.', 'muted'));
        for (const experiment of data.experiments) {
            const own = known.filter(chart => chart.experiment === experiment);
            if (!own.length) continue;
            const card = element('article', { className: 'card', id: `experiment-${experiment.id}` }, [
                element('h3', { textContent: titleOf(experiment) }),
                paragraph(experiment.summary, 'muted'),
            ]);
            put(here, card);
            const cost = own.find(chart => chart.kind === 'cost');
            if (cost) {
                addChart(card, cost, [
                    ['column', 'Show', columnOptions(chartKit.costsOf(report, experiment))],
                    ['x', 'against', chartKit.loadsOf(experiment).map(axis => [axis.name, axis.name])],
                    ['xLog', 'across', scales], ['yLog', 'upwards', scales],
                ]);
                const note = shapeNote(experiment);
                if (note) put(card, note);
                if (experiment.fits.length) put(card, fitTable(experiment));
            }
            put(card, element('h4', { textContent: 'Where the time of a frame goes' }));
            const parts = own.find(chart => chart.kind === 'stages');
            const first = chartKit.build(report, { ...parts, width: 900 });
            addChart(card, parts, [['world', 'World', (first.state?.worlds || []).map(world => [world, world])]]);
        }
        const frames = known.find(chart => chart.kind === 'frames');
        if (frames) {
            const left = data.framesLeftOut ? ` ${plural(data.framesLeftOut, 'cell')} more have theirs in runs/*/frames.csv alone.` : '';
            const card = element('article', { className: 'card', id: 'frame-times' }, [
                element('h3', { textContent: 'Frame times of a run' }),
                paragraph(`In their order, and how often each occurs; the first repetition of each cell.${left}`, 'muted'),
            ]);
            put(here, card);
            addChart(card, frames, [['run', 'Run', data.frames.map(item => [item.run, `${shortTitle(experimentOf(item.experiment))}: ${item.label}`])]]);
        }
    };

    const addQuality = () => {
        const here = section('quality');
        const own = chartKit.list(report).filter(chart => chart.kind === 'quality');
        if (!own.length) {
            put(here, paragraph('No run in this folder was compared with exact pictures. Use run --metrics, or metrics = true in a suite.', 'muted'));
            return;
        }
        put(here, paragraph('The error of a picture against its cost. reports/METRICS.md in the source tree defines every metric.', 'muted'));
        for (const chart of own) {
            const card = element('article', { className: 'card' }, [element('h3', { textContent: titleOf(chart.experiment) })]);
            put(here, card);
            const costs = ['frame_ms_median', 'memory_bytes', 'gpu_bytes', 'cpu_bytes', 'primitives_median'].filter(name => chartKit.costsOf(report, chart.experiment).includes(name));
            addChart(card, chart, [
                ['metric', 'Metric', columnOptions(chartKit.metricsOf(report, chart.experiment))], ['against', 'against', columnOptions(costs)],
                ['xLog', 'across', scales], ['yLog', 'upwards', scales],
            ]);
        }
    };

    const addPictures = () => {
        const here = section('pictures');
        if (!data.pictures.length) {
            put(here, paragraph('No run in this folder saved pictures.', 'muted'));
            return;
        }
        const linked = data.linkedPictures ? ` ${plural(data.linkedPictures, 'picture')} are too many for this file and are read from runs/ beside it.` : '';
        put(here, paragraph(`Any two of a world at a frame. Shown as JPEG where that is smaller; the numbers come from the EXR files in runs/.${linked}`, 'muted'));
        put(here, element('article', { className: 'card' }, [pictureViewer.build(report, id => shortTitle(experimentOf(id)))]));
    };

    const addClaims = () => {
        const here = section('claims');
        if (!data.claims.length) put(here, paragraph('This folder contains no experiment of a paper, so there is no claim to test.', 'muted'));
        for (const paper of data.papers) {
            const claims = data.claims.filter(claim => claim.paper === paper.id);
            if (!claims.length) continue;
            put(here, element('article', { className: 'card' }, [
                element('h3', { textContent: paper.title }),
                paragraph([paper.authors + (paper.year ? ` (${paper.year})` : ''), paper.venue].filter(Boolean).join(', '), 'muted'),
                table(claimTable.heads, claims.map(claim => claimTable.row(report, claim, runLinks)), 'stacking'),
                paragraph('Confirmed: in every cell of the experiment the 95 % interval lies within the values for which the claim is true. Refuted: in every cell wholly outside. ' +
                    'Depends: true in some cells, false in others. Unresolved: anything else, or fewer than 6 repetitions or 5 seeds. ' +
                    'A control is other data for which the outcome is known; if the rule does not find it, the claim is untestable.', 'note'),
            ]));
        }
    };

    const addMachine = () => {
        const here = section('machine');
        const fields = [['cpu', 'CPU'], ['cores', 'cores'], ['ram_bytes', 'memory'], ['governor', 'governor'], ['virtual_machine', 'virtual machine'], ['kernel', 'kernel'],
            ['gl_renderer', 'OpenGL renderer'], ['gl_vendor', 'OpenGL vendor'], ['gl_version', 'OpenGL version'], ['gl_platform', 'platform'], ['adapter', 'adapter'], ['adapter_why', 'chosen because'], ['gpu_timers', 'GPU timers'],
            ['version', 'dustbench'], ['git_commit', 'commit'], ['git_dirty', 'uncommitted changes'], ['compiler', 'compiler'], ['flags', 'flags'], ['build_type', 'build']];
        const text = (name, value) => (name === 'ram_bytes' ? `${(Number(value) / 2 ** 30).toFixed(1)} GiB` : value || '–');
        if (data.machines.length)
            put(here, element('article', { className: 'card' }, [
                element('h3', { textContent: data.machines.length > 1 ? `${data.machines.length} machines` : 'Machine' }),
                table([[''], ...data.machines.map((machine, index) => [data.machines.length > 1 ? `machine ${index + 1}` : '', 'break'])],
                    fields.map(([name, label]) => [label, ...data.machines.map(machine => text(name, machine[name]))])),
            ]));
        put(here, element('article', { className: 'card' }, [
            element('h3', { textContent: 'How it was measured' }),
            paragraph('A frame consists of input, vehicle, simulation, building, sorting, upload, the opaque scene and drawing, without vertical sync. Each run is a separate process. ' +
                'Before it is timed, its picture is compared with that of a checked run, and unrecorded frames warm up. Stages are timed one by one and add up ' +
                'to the frame; queued GPU work appears in the wait. Pictures and metrics are made outside the timed frames.'),
            element('p', {}, ['Everything on this page comes from summary.csv, claims.csv and runs/ in the same folder; ', element('code', { textContent: 'dustbench report --text' }), ' prints the tables.']),
            element('details', {}, [element('summary', { textContent: 'Columns and files (SCHEMA)' }), section('schema').content.cloneNode(true)]),
            element('details', {}, [element('summary', { textContent: 'Licence of the chart library' }), section('licence').content.cloneNode(true)]),
        ]));
        if (data.warnings.length)
            put(here, element('article', { className: 'card', id: 'warnings' }, [
                element('h3', { textContent: 'Warnings of the runs' }),
                paragraph('No run is excluded because of them.', 'muted'),
                table([['warning, in the words of the first run'], ['runs', 'number']], data.warnings.map(item => [item.warning, String(item.runs.length)])),
            ]));
        put(here, element('article', { className: 'card', id: 'not-done' }, [
            element('h3', { textContent: 'Skipped and failed' }),
            data.notDone.length ? table([['run', 'break'], ['status'], ['reason']], data.notDone.map(item => [item.run, item.status, item.reason]))
                : paragraph('None: every run was done.', 'muted'),
        ]));
    };

    const addHead = () => {
        const done = data.runs.length - data.notDone.length;
        const machine = data.machines[0];
        const date = new Date(data.written);
        section('lead').textContent = [
            data.machines.length > 1 ? `${data.machines.length} machines, listed at the end` : machine ? `${machine.cpu || 'unknown CPU'}, ${plural(Number(machine.cores), 'core')}, drawn by ${machine.gl_renderer || 'an unknown renderer'}` : '',
            `written ${date.toISOString().slice(0, 16).replace('T', ' ')} UTC by dustbench ${data.version}`,
        ].filter(Boolean).join('; ') + '.';
        const facts = [[String(done), done === 1 ? 'run done' : 'runs done'], [String(data.experiments.length), data.experiments.length === 1 ? 'experiment' : 'experiments']];
        for (const verdict of ['confirmed', 'refuted', 'depends', 'unresolved', 'untestable', 'not-tested'])
            if (data.claims.some(claim => claim.verdict === verdict)) facts.push([String(data.claims.filter(claim => claim.verdict === verdict).length), `claims ${verdict}`.replace('-', ' ')]);
        put(section('facts'), ...facts.map(([number, text]) =>
            element('div', { className: 'fact' }, [element('b', { textContent: number }), element('span', { textContent: text })])));
        if (data.problems.length)
            put(section('problems'), element('aside', { className: 'problems' }, [
                element('b', { textContent: 'Read this first' }),
                element('ul', {}, data.problems.slice(0, 20).map(text => element('li', { textContent: text }))),
                ...(data.problems.length > 20 ? [paragraph(`and ${data.problems.length - 20} more of the kind`, 'note')] : []),
            ]));
        const methods = [...new Set(data.experiments.flatMap(item => item.cells.map(cell => cell.method)))].sort();
        put(section('methods'), ...methods.map(method => {
            const title = data.methods.find(item => item.id === method)?.title || method;
            const chip = element('button', { type: 'button', className: 'chip', textContent: method, title, dataset: { method }, attributes: { 'aria-pressed': 'true' } });
            chip.addEventListener('click', () => {
                if (!hidden.delete(method)) hidden.add(method);
                chip.setAttribute('aria-pressed', String(!hidden.has(method)));
                drawAll();
            });
            return chip;
        }));
    };

    addHead();
    addPerformance();
    addQuality();
    addPictures();
    addClaims();
    addMachine();
    showTheme();

    section('theme').addEventListener('click', () => setTheme(theme === 'dark' ? 'light' : 'dark'));
    asked.addEventListener('change', () => setTheme(asked.matches ? 'dark' : 'light'));
    // Ink on paper is dark.
    let before = null;
    window.addEventListener('beforeprint', () => {
        before = theme;
        setTheme('light');
    });
    window.addEventListener('afterprint', () => setTheme(before));
    let lastWidth = window.innerWidth, resizing = null;
    window.addEventListener('resize', () => {
        if (window.innerWidth === lastWidth) return;
        lastWidth = window.innerWidth;
        clearTimeout(resizing);
        resizing = setTimeout(drawAll, 200);
    });

    // One chart a turn, so that the page can be read and scrolled from the start.
    (async () => {
        for (const chart of charts) {
            await chart.draw();
            await new Promise(resolve => setTimeout(resolve));
        }
        document.documentElement.dataset.ready = String(Math.round(performance.now()));
    })();
})();
