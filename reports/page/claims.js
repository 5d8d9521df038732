// The claims of a paper, each as a reviewer's paragraph: claim, result, test, control, and what would change the verdict.
const claimList = (() => {
    const { element, put, shape, plural } = pageKit;
    const { withUnit } = chartStyle;
    const verdictMarks = { confirmed: '✓', refuted: '✗', depends: '±', unresolved: '?', untestable: '!', 'not-tested': '–' };
    const controlTexts = { turned: 'control reversed it', 'not-turned': 'control did not reverse it', 'not-run': 'control not run' };

    /// Numbers at which a scale has ticks: 1, 2 or 5 times powers of ten; on a logarithmic one of many decades, tens.
    const ticksOf = (low, high, log) => {
        if (log) {
            const ticks = [];
            for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power)
                for (const factor of Math.log10(high / low) > 2.5 ? [1] : [1, 2, 5]) ticks.push(factor * 10 ** power);
            const within = ticks.filter(tick => tick >= low && tick <= high);
            if (within.length > 1) return within.filter((tick, index) => index % Math.ceil(within.length / 4) === 0);
        }
        // A scale needs at least two ticks: otherwise take the next finer step.
        const stepOf = place => [1, 2, 5][(place % 3 + 3) % 3] * 10 ** Math.floor(place / 3);
        let place = 3 * Math.floor(Math.log10((high - low) / 3));
        while (stepOf(place) < (high - low) / 3) ++place;
        for (;; --place) {
            const step = stepOf(place), ticks = [];
            for (let index = Math.ceil(low / step); index * step <= high + step / 1e6; ++index) ticks.push(Number((index * step).toPrecision(12)));
            if (ticks.length > 1) return ticks;
        }
    };
    /// In the unit of the claim's sentence, shortened to % or × where possible.
    const tickText = (tick, unit) => withUnit(tick, unit.startsWith('share') ? 'share' : ['×', 'ms', 'bytes'].includes(unit) ? unit : '', 12, true);
    /// A scale with the measured interval and the values for which the claim is true.
    const rangePicture = (claim, unit) => {
        if (claim.measured === null || (claim.min === null && claim.max === null)) return '';
        const width = 260, edge = 18;
        const marks = [claim.measured, claim.low, claim.high, claim.min, claim.max].filter(value => value !== null);
        let [low, high] = [Math.min(...marks), Math.max(...marks)];
        const log = low > 0 && high / low > 4;
        const bend = value => (log ? Math.log(value) : value);
        const unbend = value => (log ? Math.exp(value) : value);
        const room = (bend(high) - bend(low)) * 0.15 || Math.abs(bend(low)) * 0.2 || 1;
        [low, high] = [bend(low) - room, bend(high) + room];
        const at = value => edge + (width - 2 * edge) * (bend(value) - low) / (high - low);
        const svg = shape('svg', { viewBox: `0 0 ${width} 40`, class: 'claim-range', role: 'img' });
        const [from, to] = [claim.min === null ? edge : at(claim.min), claim.max === null ? width - edge : at(claim.max)];
        const title = shape('title');
        title.textContent = `true in the green range, ${words.rangeOf(claim, unit)}; measured ${words.measuredText(claim, unit)}`;
        put(svg, title, shape('rect', { x: from, y: 3, width: Math.max(to - from, 1), height: 16, fill: 'var(--good)', 'fill-opacity': 0.2 }));
        for (const bound of [claim.min, claim.max])
            if (bound !== null) put(svg, shape('line', { x1: at(bound), x2: at(bound), y1: 3, y2: 19, stroke: 'var(--good)', 'stroke-width': 1.5 }));
        if (words.hasInterval(claim)) put(svg, shape('line', { x1: at(claim.low), x2: at(claim.high), y1: 11, y2: 11, stroke: 'var(--ink)', 'stroke-width': 2 }));
        put(svg, shape('circle', { cx: at(claim.measured), cy: 11, r: 4, fill: 'var(--ink)' }), shape('line', { x1: edge, x2: width - edge, y1: 22.5, y2: 22.5, stroke: 'var(--muted)', 'stroke-width': 1 }));
        let end = -Infinity;
        for (const tick of ticksOf(unbend(low), unbend(high), log)) {
            const text = tickText(tick, unit), x = at(tick), half = text.length * 3 + 2;
            put(svg, shape('line', { x1: x, x2: x, y1: 20, y2: 25, stroke: 'var(--muted)', 'stroke-width': 1 }));
            if (x - half < end) continue;
            end = x + half;
            const label = shape('text', { x: Math.min(Math.max(x, half), width - half), y: 36, 'text-anchor': 'middle', 'font-size': 9.5, fill: 'var(--muted)' });
            label.textContent = text;
            put(svg, label);
        }
        return svg;
    };

    const cellList = (claim, unit) => element('details', {}, [
        element('summary', { textContent: `by configuration: ${words.cellsOf(claim)}` }),
        element('ul', { className: 'cells' }, claim.cells.map(cell => element('li', {}, [
            element('span', { className: `verdict ${cell.verdict}`, textContent: verdictMarks[cell.verdict] }),
            ` ${words.cellText(claim, cell.text)}: ${words.measuredText(cell, unit, claim)}`,
        ]))),
    ]);
    /// A folder may contain both the quick and the full experiment of a suite: the one whose runs were used.
    const experimentOf = (report, claim) => {
        if (!claim.suite) return undefined;
        const used = new Set(claim.runs);
        const own = report.data.experiments.filter(item => item.suite === claim.suite);
        return own.find(item => item.cells.some(cell => cell.runs.some(run => used.has(run)))) || own[0];
    };

    /// Text between backticks is code.
    const marked = text => text.split('`').map((part, index) => (index % 2 ? element('code', { textContent: part }) : part));

    /// `runLinks(indices, text)` makes links to runs.
    const entry = (report, claim, runLinks) => {
        const unit = claim.rule ? words.quantityOf(report, claim)[1] : '';
        const experiment = experimentOf(report, claim);
        const tested = element('dd');
        if (experiment) put(tested, element('a', { href: `#experiment-${experiment.id}`, textContent: experiment.id }), '. ');
        put(tested, words.upper(words.testedOf(claim, experiment)) || '–', ...marked(claim.reason ? `. Limits: ${claim.reason}.` : '.'));
        const came = element('dd', { className: 'came-out' }, [words.resultOf(report, claim) || 'Not measured.']);
        if (claim.condition) put(came, ` ${words.upper(words.cellText(claim, claim.condition))}.`);
        if (claim.note) put(came, element('span', { className: 'muted', textContent: ` ${words.upper(claim.note)}.` }));
        const change = words.changeOf(report, claim);
        const lines = [['result', came]];
        if (claim.measured !== null || claim.runs.length) lines.push(['tested', tested]);
        if (claim.controls.length) lines.push(['control', element('dd', {}, marked(`${words.upper(controlTexts[claim.control] || '')}: ${words.controlsOf(report, claim)}.`))]);
        if (change) lines.push(['would change it', element('dd', { textContent: change })]);
        const more = element('div', { className: 'more' });
        if (claim.cells.length > 1) put(more, cellList(claim, unit));
        if (claim.runs.length) put(more, runLinks(claim.runs, plural(claim.runs.length, 'run')));
        return element('article', { className: 'claim', id: `claim-${claim.paper}-${claim.id}`, dataset: { claim: claim.id, verdict: claim.verdict } }, [
            element('div', { className: 'claim-mark' }, [
                element('b', { textContent: claim.id }),
                element('span', { className: `verdict ${claim.verdict}`, textContent: `${verdictMarks[claim.verdict]} ${claim.verdict}` }),
                element('span', { className: 'verdict-device', textContent: claim.verdictText.slice(claim.verdict.length).replace(/^:? /, '') }),
                element('span', { className: 'muted control-state', textContent: controlTexts[claim.control] || '' }),
            ]),
            element('div', { className: 'claim-text' }, [
                element('p', { className: 'claimed' }, marked(words.upper(claim.text) + '.')),
                element('dl', {}, lines.flatMap(([head, text]) => [element('dt', { textContent: head }), text])),
            ]),
            element('div', { className: 'claim-picture' }, [rangePicture(claim, unit)]),
            more,
        ]);
    };
    return { entry, verdictMarks, ticksOf };
})();
