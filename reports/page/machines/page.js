// Builds the page of several machines from the data in it.
//
// The data (bench/report/machines/machine_comparison.cpp): machines, each a line of the charts, and folders, each with claims; hardware,
// rows of [values by machine]; remarks: apart, programs, notes, and missing configurations; experiments with axes, variants, worlds (a
// value for each axis), ratios of variants (by world and all together, a side for each machine) and values of each machine; claims, with a
// result for each folder; papers; facts, the columns that methods declare.
(() => {
    const read = id => JSON.parse(document.getElementById(id).textContent);
    const report = { data: read('report-data'), columns: read('report-columns'), specifications: read('report-charts') };
    const { data } = report;

    const { element, put, paragraph, plural, button } = pageKit;
    const { columnOf } = chartData;
    const { columnsOfRatios, columnsOfTimes, comparedVariants, loadsOf, ratiosAgainst } = machineData;
    const section = name => document.getElementById(name);
    const labels = data.machines.map(machine => machine.label);

    // Theme and machines, which all charts follow.
    const look = pageLook.make([]);
    const cards = chartCards(report, look);
    const showTheme = pageLook.painter(look, 'machine', machine => chartKit.styleOf(report, labels.indexOf(machine), look.theme).colour);
    const columnOptions = names => names.map(name => [name, columnOf(report, name).name]);
    const scales = [['false', 'linear'], ['true', 'logarithmic']];
    const againstLoads = experiment => [...loadsOf(experiment).map(axis => [axis.name, axis.name]), [chartKit.rowsForm, 'all settings (rows)']];

    /// How often each agreement occurs among the first ratios of the variants.
    const agreementCounts = () => {
        const counts = new Map();
        for (const experiment of data.experiments)
            for (const ratio of experiment.ratios) {
                const { agreement } = ratio.worlds.length > 1 ? ratio.all : ratio.worlds[0];
                counts.set(agreement, (counts.get(agreement) || 0) + 1);
            }
        return counts;
    };
    const countLine = (counts, what) => {
        const total = [...counts.values()].reduce((sum, count) => sum + count, 0);
        const order = ['agree', 'agree, by different factors', 'differ', 'open', 'one machine only'];
        return element('p', { className: 'verdicts' }, [`${plural(total, what)}: `, ...order.filter(name => counts.get(name)).map(name => {
            const mark = machineTables.agreementMark(name);
            mark.textContent = `${counts.get(name)} ${name}`;
            return mark;
        })]);
    };

    /// Machines by verdict: `faster on lab; slower on laptop and vm`.
    const saidBy = sides => {
        const said = new Map();
        sides.forEach((side, machine) => side && side[0] !== null && said.set(side[4], [...(said.get(side[4]) || []), labels[machine]]));
        return [...said].map(([verdict, names]) => `${chartKit.verdictText(verdict)} on ${words.listOf(names)}`).join('; ');
    };
    /// The ratios on which machines differ, against the reference that each experiment opens on.
    const differences = () => data.experiments.flatMap(experiment => columnsOfRatios(experiment).flatMap(column =>
        ratiosAgainst(experiment, column, experiment.reference).map(item => ({ item, row: item.worlds.length > 1 ? item.all : item.worlds[0] }))
            .filter(({ row }) => row.agreement === 'differ').map(({ item, row }) => element('li', {}, [
                element('b', { textContent: `${experiment.variants[item.variant].label} against ${experiment.variants[experiment.reference].label}` }),
                `, ${columnOf(report, column).name}: ${saidBy(row.sides)}. `, element('a', { href: `#experiment-${experiment.id}`, textContent: experiment.title }),
            ]))));

    const addHead = () => {
        section('title').textContent = `${labels.join(', ')}: side by side`;
        const here = section('first-screen');
        const differing = differences();
        const most = 20, mostDifferences = 6;
        const shared = data.experiments.filter(experiment => experiment.ratios.length).length;
        put(here, element('section', { className: 'answers' }, [
            element('b', { textContent: 'Do the machines agree on which method is faster?' }),
            shared ? countLine(agreementCounts(), 'ratio') : paragraph('No ratio can be formed, because no world has times of two methods or settings.'),
            ...(differing.length ? [element('ul', {}, differing.slice(0, mostDifferences))] : []),
            ...(differing.length > mostDifferences ? [paragraph(`and ${differing.length - mostDifferences} more below`, 'note')] : []),
            ...(data.claims.length ? [countLine(data.claims.reduce((counts, claim) => counts.set(claim.agreement, (counts.get(claim.agreement) || 0) + 1), new Map()), 'claim')] : []),
        ]));
        put(here, element('p', { className: 'across' }, [
            element('b', { textContent: 'Times of different machines are not compared here. ' }),
            'Each ratio compares two methods on the same machine. Only ',
            element('a', { href: '#times', textContent: 'Times of each machine' }), ' shows times of several machines in one chart.',
        ]));
        const date = new Date(data.written).toISOString().slice(0, 16).replace('T', ' ');
        put(here, paragraph(`${plural(data.machines.length, 'machine')}; ${plural(data.experiments.length, 'experiment')}; written ${date} UTC by dustbench ${data.version}.`, 'lead'));
        const { apart, programs, notes, missing } = data.remarks;
        const lists = [
            ['Cannot be compared', apart], ['The builds differ, so ratios may differ regardless of the machines', programs],
            ['Notes', [...notes, ...(missing.length ? [`${plural(missing.length, 'configuration is', 'configurations are')} missing on some machines: see the list of missing configurations`] : [])]],
        ].filter(([, list]) => list.length);
        if (lists.length)
            put(section('problems'), element('aside', { className: 'problems' }, lists.flatMap(([head, list]) => [
                element('b', { textContent: head }),
                element('ul', {}, [...list.slice(0, most).map(text => element('li', { textContent: text })), ...(list.length > most ? [element('li', { textContent: `and ${list.length - most} more` })] : [])]),
            ])));
    };

    const addRatios = () => {
        const here = section('ratios');
        const compared = data.experiments.filter(experiment => experiment.ratios.length);
        if (!compared.length) put(here, paragraph('No world has times of two methods or settings.', 'muted'));
        for (const experiment of compared) {
            const card = element('article', { className: 'card', id: `experiment-${experiment.id}` }, [element('h3', { textContent: experiment.title }), paragraph(experiment.summary, 'muted')]);
            put(here, card);
            const columns = columnsOfRatios(experiment);
            const chart = { id: `${experiment.id}-ratios`, kind: 'ratio', experiment };
            cards.add(card, chart, [
                ['column', 'Show', columnOptions(columns)],
                ['against', 'relative to', comparedVariants(experiment).map(index => [String(index), experiment.variants[index].label])],
                ['x', 'over', againstLoads(experiment)], ['xLog', 'x axis', scales], ['yLog', 'y axis', scales], ['world', 'World', []],
            ]);
            const place = element('div');
            put(card, place);
            const valueOf = key => card.querySelector(`select[data-key=${key}]`)?.value;
            const show = () => {
                const { state } = chartKit.build(report, { ...chart, ...pageState.ofChart(chart.id), width: 900, theme: look.theme, hidden: new Set() });
                const [column, against] = state ? [state.column, state.against] : [valueOf('column') || columns[0], valueOf('against') || experiment.reference];
                place.replaceChildren(machineTables.ratios(report, experiment, column, Number(against)));
                showTheme();
            };
            card.addEventListener('change', show);
            show();
        }
    };

    const addClaims = () => {
        const here = section('claims');
        if (!data.claims.length) put(here, paragraph('These folders contain no experiments from a paper, so there are no claims to test.', 'muted'));
        for (const paper of new Set(data.claims.map(claim => claim.paper)))
            put(here, element('article', { className: 'card' }, [
                element('h3', { textContent: data.papers[paper] || paper }),
                machineTables.claims(report, data.claims.filter(claim => claim.paper === paper)),
                paragraph('Each verdict is that of the folder\'s own report. Agree: the same verdict in all folders that test the claim. Open: unresolved or untestable in some folders.', 'note'),
            ]));
    };

    const addTimes = () => {
        const here = section('times');
        put(here, element('p', { className: 'across' }, [
            element('b', { textContent: 'These are times of different machines in one chart. ' }),
            'They show how fast each machine is with its build. They do not show which method is faster: for that, see ', element('a', { href: '#ratios', textContent: 'the ratios' }), '.',
        ]));
        const timed = data.experiments.filter(experiment => experiment.values.length);
        if (!timed.length) put(here, paragraph('No run has measured times.', 'muted'));
        for (const experiment of timed) {
            const card = element('article', { className: 'card' }, [element('h3', { textContent: experiment.title })]);
            put(here, card);
            cards.add(card, { id: `${experiment.id}-times`, kind: 'times', experiment }, [
                ['column', 'Show', columnOptions(columnsOfTimes(experiment))], ['x', 'over', againstLoads(experiment)], ['xLog', 'x axis', scales], ['yLog', 'y axis', scales], ['world', 'World', []],
            ]);
        }
    };

    const addMissing = () => {
        const here = section('missing');
        if (!data.remarks.missing.length) put(here, paragraph('None, except for those that the top of the page explains. Every other configuration was measured on every machine.', 'muted'));
        else put(here, element('article', { className: 'card' }, [
            paragraph('A configuration is all runs that differ only in the repetition. The table lists the configurations that some machines have and others lack, unless a line at the top of the page explains why.', 'muted'), machineTables.missing(report),
        ]));
    };

    const addDefinitions = () => {
        put(section('definitions'), element('article', { className: 'card' }, [
            paragraph('Ratio: the time of a method, with its settings, over that of another in the same folder on the same machine. Runs are paired by world, parameters, seed and repetition. ' +
                'The value is the geometric mean, with the 95\u00a0% interval of Student\'s t over the logarithms of the paired runs. If all machines share several seeds, the interval is over the seeds, each the mean of its repetitions. ' +
                'Faster: the interval lies entirely below 1/1.02. Slower: entirely above 1.02. Same: between. Unresolved: anything else, and always with fewer than 6 pairs.'),
            paragraph('All together: each repetition or seed gives one ratio, the geometric mean over the loads and worlds that all machines with both methods share.'),
            paragraph('Agree: all machines give the same verdict, and their intervals overlap. By different factors: the same verdict, but two intervals do not overlap. Differ: two verdicts. Open: unresolved on a machine, and no machines contradict each other.'),
            paragraph('Times: medians over the repetitions, or over the medians of several seeds, with intervals from the order statistics.'),
            element('details', {}, [element('summary', { textContent: 'Licence of the chart library' }), section('licence').content.cloneNode(true)]),
        ]));
    };

    const addChips = () => put(section('chips'), ...data.machines.map(machine => {
        const chip = button(machine.label, () => {
            if (!look.hidden.delete(machine.label)) look.hidden.add(machine.label);
            chip.setAttribute('aria-pressed', String(!look.hidden.has(machine.label)));
            cards.drawAll();
        }, { className: 'chip', title: 'show or hide in the charts', dataset: { machine: machine.label }, attributes: { 'aria-pressed': 'true' } });
        return chip;
    }));

    addHead();
    addChips();
    put(section('machines'), element('article', { className: 'card' }, [machineTables.hardware(report), paragraph('Bold: rows in which the machines differ.', 'note')]));
    addRatios();
    addClaims();
    addTimes();
    addMissing();
    addDefinitions();

    pageLook.follow(look, cards, showTheme);
})();
