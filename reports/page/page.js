// Builds the page from the data in it.
//
// The data (bench/report/report_json.cpp): folder, written, version; problems; files next to the page; machines, methods,
// facts and papers; runs, the ids that the other parts index; experiments with axes, cells, fits, published numbers, verdicts
// of their comparisons and the suite's file; claims; frames, the frame times of some runs; pictures by world and frame;
// heat, the colours of difference maps; notDone; warnings.
(() => {
    const read = id => JSON.parse(document.getElementById(id).textContent);
    const report = { data: read('report-data'), columns: read('report-columns'), specifications: read('report-charts') };
    const { data } = report;

    const { element, put, paragraph, plural, table, button, download } = pageKit;
    const section = name => document.getElementById(name);
    const runLinks = (indices, text) => {
        const most = 200;
        if (data.tablesOnly) return element('span', { className: 'muted control-state', textContent: `${text}, not kept` });
        const list = element('ul', { className: 'runs' }, indices.slice(0, most).map(index => element('li', {}, [element('a', {
            href: `${data.root}runs/${encodeURIComponent(data.runs[index])}/run.json`, textContent: data.runs[index],
        })])));
        if (indices.length > most) put(list, element('li', { textContent: `and ${indices.length - most} more` }));
        return element('details', {}, [element('summary', { textContent: text }), list]);
    };
    const experimentOf = id => data.experiments.find(item => item.id === id);
    const quickMark = experiment => (pageHead.isQuick(experiment) ? ' (quick)' : '');
    const shortTitle = experiment => experiment.title.split(':')[0] + quickMark(experiment);
    const titleOf = experiment => experiment.title + quickMark(experiment);

    // Suites that only the claims' controls need come last, folded.
    const controls = new Set(data.papers.flatMap(paper => paper.controls || []));
    const ofPapers = data.experiments.filter(item => item.suite && !controls.has(item.suite) && (!item.paper || !data.papers.length || data.papers.some(paper => paper.id === item.paper)));
    const isMain = experiment => !ofPapers.length || ofPapers.includes(experiment);
    const experiments = data.experiments.filter(isMain);

    // Theme and methods, which all charts follow.
    const look = pageLook.make(pageState.get('hidden').split(',').filter(Boolean));
    const cards = chartCards(report, look);
    const colourOf = method => chartKit.methodColour(report, method, look.theme);
    const showTheme = pageLook.painter(look, 'method', colourOf);

    const columnOptions = names => names.map(name => [name, chartKit.columnOf(report, name).name]);
    const scales = [['false', 'linear'], ['true', 'logarithmic']];

    const fitTable = experiment => {
        const { digits } = chartKit;
        const estimate = ([value, plusMinus]) => digits(value) + (plusMinus === null ? '' : ` ± ${digits(plusMinus, 2)}`);
        const rows = experiment.fits.map(fit => [
            [chartKit.variantOf(report, experiment, fit, fit.axis), chartKit.worldOf(experiment, fit, fit.axis)].filter(Boolean).join(', '),
            chartKit.columnOf(report, fit.column).name, fit.axis, estimate(fit.a), estimate(fit.b), estimate(fit.k), `${fit.loads}, ${fit.runs}`,
        ]);
        return element('details', {}, [
            element('summary', { textContent: `Fitted costs: ms = a + b·N^k (${plural(rows.length, 'curve')})` }),
            table([['configuration'], ['cost'], ['N'], ['a [ms]', 'number'], ['b', 'number'], ['k', 'number'], ['loads, runs', 'number']], rows),
        ]);
    };
    const suiteText = experiment => element('details', {}, [
        element('summary', { textContent: `Suite file ${experiment.suite}.toml` }),
        button('Download', () => download(`${experiment.suite}.toml`, experiment.toml, 'application/toml'), { className: 'save-toml' }),
        element('pre', { textContent: experiment.toml }),
    ]);
    const comparisonList = experiment => {
        const sentences = experiment.comparisons.flatMap(comparison => comparison.columns.filter(column => column.overall.ratio !== null)
            .map(column => words.comparisonSentence(report, comparison, column)));
        return sentences.length ? element('ul', { className: 'comparisons' }, sentences.map(({ head, text }) => element('li', {}, [element('b', { textContent: head }), `: ${text}`]))) : null;
    };

    const costControls = experiment => [
        ['column', 'Show', columnOptions(chartKit.quantitiesOf(report, experiment))],
        ['x', 'against', [...chartKit.loadsOf(experiment).filter(axis => axis.numeric).map(axis => [axis.name, axis.name]), ['bars', 'all settings (bars)']]],
        ['xLog', 'x axis', scales], ['yLog', 'y axis', scales], ['world', 'World', []],
    ];
    const addExperiment = (here, experiment, own) => {
        const card = element('article', { className: 'card', id: `experiment-${experiment.id}` }, [
            element('h3', { textContent: titleOf(experiment) }),
            paragraph(experiment.summary, 'muted'),
        ]);
        put(here, card);
        const cost = own.find(chart => chart.kind === 'cost');
        if (cost) {
            cards.add(card, cost, costControls(cost.experiment));
            // Only charts named after a figure have a published chart to compare with.
            if (!experiment.published.length && experiment.title.startsWith('Figure'))
                put(card, paragraph('Compare the shape only: the paper\'s text gives no numbers for this chart.', 'note shape-note'));
            const compared = comparisonList(experiment);
            if (compared) put(card, compared);
            if (experiment.fits.length) put(card, fitTable(experiment));
        }
        const stages = own.find(chart => chart.kind === 'stages');
        if (stages) put(card, element('h4', { textContent: 'Where the time goes' }));
        else put(card, paragraph('No times were measured, because several runs ran at once.', 'note'));
        if (stages) cards.add(card, stages, [['part', 'Show', [['own', 'the method\'s own stages'], ['frame', 'the whole frame']]], ['world', 'World', []]]);
        if (experiment.toml) put(card, suiteText(experiment));
    };

    const addPerformance = () => {
        const here = section('performance');
        const known = chartKit.list(report);
        const chartsOf = experiment => known.filter(chart => chart.experiment && chart.experiment.id === experiment.id);
        if (!known.length) put(here, paragraph('No run has measured values.', 'muted'));
        else put(here, paragraph('Each point or bar is the median over the runs, or seeds, of a configuration. The line through it is the interval that contains the true median with at least 95\u00a0% probability, ' +
            'from the order statistics of 6 or more values; with fewer values it spans the minimum and maximum. Points with the same load are drawn slightly apart. Runs alternate in random order, each in its own process.', 'muted'));
        for (const experiment of experiments) if (chartsOf(experiment).length) addExperiment(here, experiment, chartsOf(experiment));
        const frames = known.find(chart => chart.kind === 'frames');
        if (frames) {
            const left = data.framesLeftOut ? ` The frame times of ${plural(data.framesLeftOut, 'more configuration')} are only in runs/*/frames.csv.` : '';
            const card = element('article', { className: 'card', id: 'frame-times' }, [
                element('h3', { textContent: 'Frame times of a run' }),
                paragraph(`Frame times in order, and their distribution, for the first repetition of each configuration.${left}`, 'muted'),
            ]);
            put(here, card);
            const runs = data.frames.map(item => [item.run, `${shortTitle(experimentOf(item.experiment))}: ${item.label}`]);
            cards.add(card, frames, [['run', 'Run', runs.sort((a, b) => a[1].localeCompare(b[1], 'en', { numeric: true }))]]);
        }
        const others = data.experiments.filter(experiment => !isMain(experiment) && chartsOf(experiment).length);
        if (!others.length) return;
        const fold = element('details', { className: 'fold', id: 'other-runs' }, [element('summary', { textContent: `Controls and other runs (${plural(others.length, 'group')})` })]);
        for (const experiment of others) addExperiment(fold, experiment, chartsOf(experiment));
        fold.addEventListener('toggle', () => fold.open && cards.drawWithin(fold));
        put(here, fold);
    };

    const qualityCharts = chartKit.list(report).filter(chart => chart.kind === 'quality' && isMain(experimentOf(chart.experiment.id)));
    /// The chart that a suite wants to be seen first.
    const opening = qualityCharts.find(chart => chartData.opensOnCost(chart.experiment));
    const addQualityChart = (here, chart) => {
        const card = element('article', { className: 'card' }, [element('h3', { textContent: titleOf(chart.experiment) })]);
        put(here, card);
        cards.add(card, chart, [
            ['metric', 'Metric', columnOptions(chartKit.metricsOf(report, chart.experiment))],
            ['against', 'against', columnOptions(qualityChart.chargesOf(report, chart.experiment))],
            ['xLog', 'x axis', scales], ['yLog', 'y axis', scales],
        ]);
    };
    const addOpening = () => opening && addQualityChart(section('opening'), opening);

    const addQuality = () => {
        const here = section('quality');
        const own = qualityCharts.filter(chart => chart !== opening);
        if (opening) put(here, element('p', { className: 'muted' }, [element('a', { href: '#opening', textContent: titleOf(opening.experiment) }), ' is at the top of the page.']));
        if (!own.length && opening) return;
        if (!own.length) {
            const judged = experiments.some(experiment => chartKit.metricsOf(report, experiment).length);
            put(here, paragraph(judged ? 'No chart: all settings whose pictures were compared have the same cost.'
                : 'No run in this folder was compared with reference images. Use run --metrics, or metrics = true in a suite.', 'muted'));
            return;
        }
        put(here, element('p', { className: 'muted' }, ['Image error against cost. ', element('a', { href: '#metrics', textContent: 'Image metrics' }), ' defines every metric.']));
        for (const chart of own) addQualityChart(here, chart);
    };

    const addPictures = () => {
        const here = section('pictures');
        if (!data.pictures.length) {
            put(here, paragraph('No run in this folder saved pictures.', 'muted'));
            return;
        }
        const linked = data.linkedPictures ? ` ${plural(data.linkedPictures, 'picture')} did not fit in this file and will be read from runs/ next to it.` : '';
        put(here, paragraph(`Compare any two pictures of the same world and frame. The viewer opens on the picture with the largest error. Pictures are shown as JPEG where that is smaller; the numbers come from the EXR files in runs/.${linked}`, 'muted'));
        put(here, element('article', { className: 'card' }, [pictureViewer.build(report, id => shortTitle(experimentOf(id)), id => isMain(experimentOf(id)))]));
    };

    const addMap = (here, map) => {
        const name = chartKit.columnOf(report, map.claims[0].rule.along).name;
        const card = element('article', { className: 'card' }, [element('h3', { textContent: `Where claims are true, by ${name}` })]);
        put(here, card);
        cards.add(card, map);
    };

    const addClaims = () => {
        const here = section('claims');
        if (!data.claims.length) put(here, paragraph('This folder contains no experiments from a paper, so there are no claims to test.', 'muted'));
        for (const paper of data.papers) {
            const claims = data.claims.filter(claim => claim.paper === paper.id);
            if (!claims.length) continue;
            for (const map of chartKit.list(report).filter(chart => chart.kind === 'map' && chart.claims[0].paper === paper.id)) addMap(here, map);
            put(here, element('article', { className: 'card' }, [
                ...(data.papers.length > 1 ? [element('h3', { textContent: paper.title }), paragraph(pageHead.citationOf(paper), 'muted')] : []),
                ...claims.map(claim => claimList.entry(report, claim, runLinks)),
                paragraph('Confirmed: in every configuration the 95\u00a0% interval lies within the values for which the claim is true. Refuted: in every configuration it lies entirely outside. ' +
                    'Depends: true in some configurations, false in others. Unresolved: anything else, or fewer than 6 repetitions or 5 seeds. ' +
                    'A control is an input for which the verdict is known. If the rule gives another verdict for it, the claim is untestable. ' +
                    'In the small scales, the green range is where the claim is true, the point is the measured value, and the line is its interval.', 'note'),
            ]));
        }
    };

    const addOverview = () => {
        const rows = overview.rowsOf(report, experiments, shortTitle);
        put(section('overview'), rows.length ? overview.build(report, experiments, shortTitle, colourOf) : paragraph('No run has numbers for this table.', 'muted'));
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
                'Before timing starts, the picture of the run is compared with that of a checked run, and warm-up frames are drawn but not recorded. Stages are timed one by one and add up ' +
                'to the frame time. Pictures and metrics are produced outside the timed frames.'),
            element('p', {}, ['Everything on this page comes from ', ...[...data.files, ...(data.tablesOnly ? [] : ['runs/'])].flatMap((file, index) => [index ? ', ' : '', element('a', { href: data.root + file, textContent: file })]),
                `${data.root ? '' : ' in the same folder'}; `, element('code', { textContent: 'dustbench report --text' }), ' prints the tables.']),
            element('details', {}, [element('summary', { textContent: 'Licence of the chart library' }), section('licence').content.cloneNode(true)]),
        ]));
        if (data.warnings.length)
            put(here, element('article', { className: 'card', id: 'warnings' }, [
                element('h3', { textContent: 'Run warnings' }),
                paragraph('Claims leave out invalid runs only.', 'muted'),
                table([['warning, with the numbers of the first run'], ['runs', 'number']], data.warnings.map(item => [item.warning, String(item.runs.length)])),
            ]));
        put(here, element('article', { className: 'card', id: 'not-done' }, [
            element('h3', { textContent: 'Skipped and failed' }),
            data.notDone.length ? table([['run', 'break'], ['status'], ['reason']], data.notDone.map(item => [item.run, item.status, item.reason]))
                : paragraph('None: every run was completed.', 'muted'),
        ]));
    };

    const addDocuments = () => {
        for (const name of ['metrics', 'schema']) {
            const fold = element('details', { className: 'fold card' }, [element('summary', { textContent: name === 'metrics' ? 'Definitions of all metrics' : 'Contents of all files and columns' })]);
            put(fold, markdown.show(section(`${name}-text`).content.textContent, name));
            put(section(name), fold);
        }
        const open = () => {
            const target = document.getElementById(decodeURIComponent(window.location.hash.slice(1).split('?')[0]));
            const fold = target && (target.closest('details.fold') || target.querySelector(':scope > details.fold'));
            if (fold && !fold.open) {
                fold.open = true;
                target.scrollIntoView();
            }
        };
        window.addEventListener('hashchange', open);
        open();
    };

    const addMethods = () => {
        if (data.problems.length)
            put(section('problems'), element('aside', { className: 'problems' }, [
                element('b', { textContent: 'Read this first' }),
                element('ul', {}, data.problems.slice(0, 20).map(text => element('li', { textContent: text }))),
                ...(data.problems.length > 20 ? [paragraph(`and ${data.problems.length - 20} more`, 'note')] : []),
            ]));
        const methods = [...new Set(data.experiments.flatMap(item => item.cells.map(cell => cell.method)))].sort();
        put(section('methods'), ...methods.map(method => {
            const title = data.methods.find(item => item.id === method)?.title || method;
            const chip = button(method, () => {
                if (!look.hidden.delete(method)) look.hidden.add(method);
                chip.setAttribute('aria-pressed', String(!look.hidden.has(method)));
                pageState.set('hidden', [...look.hidden].join(','));
                cards.drawAll();
            }, { className: 'chip', title, dataset: { method }, attributes: { 'aria-pressed': String(!look.hidden.has(method)) } });
            return chip;
        }));
    };

    addOpening();
    pageHead.build(report, experiments, shortTitle);
    addMethods();
    addClaims();
    addOverview();
    addPerformance();
    addQuality();
    addPictures();
    addMachine();
    addDocuments();
    // A reader of a printed page cannot unfold anything.
    pageLook.follow(look, cards, showTheme, () => {
        const folded = [...document.querySelectorAll('.answers details:not([open])')];
        for (const part of folded) part.open = true;
        return () => folded.forEach(part => { part.open = false; });
    });
})();
