// The first screen: the paper, how far to trust the numbers, the verdicts, and which method is faster.
const pageHead = (() => {
    const { element, put, paragraph } = pageKit;
    const { plural, upper, listOf, comparisonSentence } = words;
    const { columnOf, shownOf, variantOf, worldOf } = chartKit;
    const verdicts = ['confirmed', 'refuted', 'depends', 'unresolved', 'untestable', 'not-tested'];

    const isQuick = experiment => Boolean(experiment.suite) && experiment.id !== experiment.suite;
    const citationOf = paper => [[paper.authors, paper.year || ''].filter(Boolean).join(', '), paper.venue].filter(Boolean).map(upper).join('. ');
    const isSoftware = machine => /llvmpipe|softpipe|swrast|swiftshader/i.test(machine.gl_renderer || '');
    const machineText = machine => [machine.cpu || 'unknown CPU', plural(Number(machine.cores), 'core')].join(', ');
    const rendererText = machine => `${isSoftware(machine) ? 'software renderer: ' : ''}${machine.gl_renderer || 'unknown renderer'}`;

    const formOf = experiments => {
        const ofSuites = experiments.filter(experiment => experiment.suite);
        const quick = ofSuites.filter(isQuick).length;
        if (!ofSuites.length) return '';
        if (!quick) return 'full run';
        const both = ofSuites.some(experiment => isQuick(experiment) && ofSuites.some(other => other.suite === experiment.suite && !isQuick(other)));
        return both ? 'full and quick run' : 'quick run: fewer loads, smaller pictures, fewer frames';
    };
    /// Warnings by kind, which is their text before the colon: `the machine is busy`, `frames stalled`.
    const kindsOf = data => {
        const kinds = new Map();
        for (const { warning, runs } of data.warnings) {
            const kind = warning.split(':')[0].replace(/^\d+ of \d+ /, '');
            kinds.set(kind, new Set([...(kinds.get(kind) || []), ...runs]));
        }
        return [...kinds].sort((a, b) => b[1].size - a[1].size);
    };
    /// Without text in brackets, and at most one line long.
    const shortOf = kind => {
        const text = kind.replace(/ *\([^)]*\)/g, '');
        return text.length > 75 ? text.slice(0, 72).replace(/\s+\S*$/, '') + ' …' : text;
    };
    const warningsText = data => {
        if (!data.warnings.length) return 'no run has warnings';
        const touched = new Set(data.warnings.flatMap(item => item.runs)).size;
        const short = kindsOf(data).slice(0, 3).map(([kind, runs]) => `${shortOf(kind)} (${runs.size})`);
        return `${touched} of ${data.runs.length} runs with warnings: ${short.join(', ')}${kindsOf(data).length > 3 ? ' …' : ''}`;
    };

    /// Facts to know before reading any number: [text, whether it is a reason for doubt].
    const trustOf = (data, experiments) => {
        const seeds = Math.max(0, ...experiments.map(experiment => experiment.axes.find(axis => axis.name === 'seed')?.values.length || 0));
        const repetitions = Math.max(0, ...experiments.flatMap(experiment => experiment.cells.map(cell => cell.runs.length)));
        const items = [];
        const form = formOf(experiments);
        if (form) items.push([form, isQuick(experiments.find(experiment => experiment.suite))]);
        items.push([[plural(Math.max(seeds, 1), 'seed'), plural(repetitions, 'repetition')].join(', '), repetitions < 6 && seeds < 5]);
        items.push([warningsText(data), data.warnings.length > 0]);
        if (data.notDone.length) items.push([`${data.notDone.length} of ${data.runs.length} runs not completed`, true]);
        for (const renderer of new Set(data.machines.map(rendererText))) items.push([renderer, renderer.startsWith('software')]);
        return items;
    };

    /// The answer if no suite declares comparisons: the first experiment with several methods in one world, at its last load.
    /// Runs outside suites were chosen to be compared, so settings of one method count as well.
    const fastestOf = (report, experiments) => {
        for (const whole of experiments) {
            const experiment = shownOf(whole);
            const cells = chartData.inOrder(experiment, experiment.cells.filter(cell => cell.method !== chartStyle.baseline && chartData.valueOf(cell, 'frame_ms_median')));
            const world = cells.length ? worldOf(experiment, cells[cells.length - 1]) : '';
            const here = cells.filter(cell => worldOf(experiment, cell) === world);
            const several = whole.suite ? new Set(here.map(cell => cell.method)).size : here.length;
            if (several < 2) continue;
            const column = here.every(cell => chartData.valueOf(cell, 'method_ms_median')) ? 'method_ms_median' : 'frame_ms_median';
            const [first, second] = [...here].sort((a, b) => chartData.valueOf(a, column)[0] - chartData.valueOf(b, column)[0]);
            const [a, b] = [first, second].map(cell => chartData.valueOf(cell, column));
            const text = ([measured, low, high]) => words.measuredText({ measured, low, high }, 'ms');
            const sure = first.runs.length < 2 ? 'one run each: not resolved' : a[2] < b[1] ? 'their intervals do not overlap' : 'their intervals overlap: not resolved';
            return [{
                head: `${variantOf(report, experiment, first)} has the shortest ${columnOf(report, column).name}`,
                text: `${text(a)}, followed by ${variantOf(report, experiment, second)} with ${text(b)}; ${sure}${world ? `; at ${world}` : ''}.`, experiment,
            }];
        }
        return [];
    };
    /// Which is faster, by how much and how certainly: the comparisons that the suites declare, resolved ones first.
    const answersOf = (report, experiments) => {
        const declared = experiments.flatMap(experiment => (experiment.comparisons || []).flatMap(comparison => comparison.columns
            .filter(column => column.overall.pairs > 1 && column.overall.ratio !== null)
            .map(column => ({ ...comparisonSentence(report, comparison, column), experiment }))));
        declared.sort((a, b) => b.resolved - a.resolved);
        return declared.length ? declared : fastestOf(report, experiments);
    };

    const facts = data => verdicts.map(verdict => [verdict, data.claims.filter(claim => claim.verdict === verdict).length]).filter(([, count]) => count);
    const mostAnswers = 4;

    /// `experiments`: those of the paper, without its controls.
    const build = (report, experiments, titleOf) => {
        const { data } = report;
        const here = document.getElementById('first-screen');
        const [paper] = data.papers;
        if (data.papers.length === 1) {
            document.getElementById('title').textContent = paper.title;
            put(here, paragraph(citationOf(paper), 'citation'));
        }
        put(here, element('section', { className: 'trust', ariaLabel: 'how far to trust this' }, [
            element('b', { textContent: 'How far to trust this' }),
            element('ul', {}, trustOf(data, experiments).map(([text, doubt]) => element('li', { className: doubt ? 'doubt' : '', textContent: text }))),
        ]));
        const answers = answersOf(report, experiments);
        if (answers.length) {
            const machines = data.machines.length > 1 ? `${data.machines.length} machines` : data.machines.length ? machineText(data.machines[0]) : '';
            const lines = answers.map(({ head, text, experiment }) => element('li', {}, [
                element('a', { href: `#experiment-${experiment.id}`, textContent: titleOf(experiment) }), ': ', element('b', { textContent: head }), `: ${text}`,
            ]));
            const box = element('section', { className: 'answers' }, [
                element('b', { textContent: `Which is faster here${machines ? ` (${machines})` : ''}` }), element('ul', {}, lines.slice(0, mostAnswers)),
            ]);
            if (lines.length > mostAnswers)
                put(box, element('details', {}, [element('summary', { textContent: plural(lines.length - mostAnswers, 'more comparison') }), element('ul', {}, lines.slice(mostAnswers))]));
            put(here, box);
        }
        const counts = facts(data);
        if (counts.length) put(here, element('p', { className: 'verdicts' }, [
            element('span', {}, [element('a', { href: '#claims', textContent: plural(data.claims.length, 'claim') }), ':']),
            ...counts.map(([verdict, count]) => element('span', { className: `verdict ${verdict}`, textContent: `${count} ${verdict}` })),
        ]));
        const done = data.runs.length - data.notDone.length;
        const date = new Date(data.written).toISOString().slice(0, 16).replace('T', ' ');
        const lead = [
            data.machines.length > 1 ? `${data.machines.length} machines, listed at the end` : data.machines.length ? machineText(data.machines[0]) : '',
            plural(done, 'run'), plural(data.experiments.length, 'experiment'), `written ${date} UTC by dustbench ${data.version}`,
        ];
        const line = element('p', { className: 'lead' }, [lead.filter(Boolean).join('; ') + '. ']);
        if (data.files.length) put(line, 'Tables: ', ...data.files.flatMap((file, index) => [index ? ', ' : '', element('a', { href: data.root + file, textContent: file })]), '.');
        put(here, line);
    };
    return { build, isQuick, citationOf, isSoftware, answersOf, trustOf };
})();
