// The tables of several machines: hardware, ratios, claims, and missing configurations.
const machineTables = (() => {
    const { element, put, paragraph, plural, table } = pageKit;
    const { columnOf, distinct } = chartData;
    const { hasInterval, ratiosAgainst, worldText } = machineData;
    const { digits } = chartStyle;
    const verdictMarks = { confirmed: '✓', refuted: '✗', depends: '±', unresolved: '?', untestable: '!', 'not-tested': '–' };
    const agreementClass = text => ({ agree: 'agree', 'agree, by different factors': 'factor', differ: 'differ', open: 'open' }[text] || 'alone');
    const agreementMark = text => element('span', { className: `agreement ${agreementClass(text)}`, textContent: text });
    const machineName = machine => element('span', { className: 'machine-name', textContent: machine.label, dataset: { machine: machine.label } });
    /// Puts the machines' names, in their colours, into the column heads.
    const nameHeads = (place, machines, from) => {
        const heads = place.querySelectorAll('thead th');
        machines.forEach((machine, index) => heads[index + from].replaceChildren(machineName(machine)));
        return place;
    };

    const hardware = ({ data }) => {
        const made = table([[''], ...data.machines.map(() => ['', 'break'])], data.hardware.map(row => [row.name, ...row.values.map(value => value || 'unknown')]), 'hardware');
        data.hardware.forEach((row, index) => made.querySelectorAll('tbody tr')[index].classList.toggle('differs', row.differs && row.name !== 'folder'));
        return nameHeads(made, data.machines, 1);
    };

    const ratioCell = side => {
        if (!side) return element('span', { className: 'muted', textContent: '–', title: 'not measured' });
        if (side[0] === null) return element('span', { className: 'muted', textContent: side[5] });
        const [ratio, low, high, pairs, verdict, reason] = side;
        const said = reason || (pairs > 1 ? chartKit.verdictText(verdict) : 'one run');
        return element('span', {}, [
            `${digits(ratio)}× `, hasInterval([ratio, low, high]) ? element('span', { className: 'interval', textContent: `[${digits(low)}, ${digits(high)}]` }) : '',
            element('span', { className: 'said', textContent: said }),
        ]);
    };
    /// Every ratio against one variant: over all common worlds and, folded, for each world.
    const ratios = (report, experiment, column, reference) => {
        const { machines } = report.data;
        const items = ratiosAgainst(experiment, column, reference);
        const heads = [['method', 'method'], ['machines'], ...machines.map(() => ['', 'number'])];
        const rowOf = (text, row) => [text, agreementMark(row.agreement), ...row.sides.map(ratioCell)];
        const alone = items.every(item => item.worlds.length === 1);
        const summary = items.map(item => rowOf(experiment.variants[item.variant].label, item.worlds.length > 1 ? item.all : item.worlds[0]));
        const place = element('div', {}, [nameHeads(table(heads, summary, 'ratios'), machines, 2)]);
        const counts = distinct(items.filter(item => item.worlds.length > 1).map(item => item.common));
        const over = counts.length === 1 ? `${plural(counts[0], 'load or world', 'loads and worlds')} that every machine has` : 'the loads and worlds that every machine has';
        put(place, paragraph(`${words.upper(columnOf(report, column).name)} relative to that of ${experiment.variants[reference].label}${alone ? '' : `; all together: the geometric mean over ${over}`}.`, 'note'));
        const rest = items.filter(item => item.worlds.length > 1);
        if (rest.length) {
            const rows = rest.flatMap(item => item.worlds.map(row => rowOf(`${experiment.variants[item.variant].label} at ${worldText(experiment, row.world)}`, row)));
            put(place, element('details', {}, [element('summary', { textContent: `Load by load: ${plural(rows.length, 'row')}` }), nameHeads(table(heads, rows, 'ratios'), machines, 2)]));
        }
        return place;
    };

    const claimCell = (claim, unit, limits) => {
        if (!claim) return element('span', { className: 'muted', textContent: 'not in this folder' });
        return element('span', {}, [
            element('span', { className: `verdict ${claim.verdict}`, textContent: `${verdictMarks[claim.verdict]} ${claim.verdictText}` }),
            element('span', { className: 'said', textContent: claim.measured === null ? '' : words.measuredText(claim, unit, limits) }),
            claim.condition ? element('span', { className: 'said', textContent: claim.condition }) : '',
        ]);
    };
    const claims = (report, list) => table(
        [['claim', 'wide'], ['machines'], ...report.data.folders.map(label => [label, 'number'])],
        list.map(claim => {
            const [quantity, unit] = claim.rule ? words.quantityOf(report, claim) : ['', ''];
            const expected = words.rangeOf(claim, unit);
            return [
                element('span', {}, [element('b', { textContent: `${claim.id} ` }), `${words.upper(claim.text)}.`,
                    element('span', { className: 'said', textContent: quantity ? `${words.upper(quantity)}${expected ? `; true if ${expected}` : ''}.` : '' })]),
                agreementMark(claim.agreement),
                ...claim.folders.map(own => claimCell(own, unit, claim)),
            ];
        }), 'ratios claims-table');

    const missing = ({ data }) => {
        const list = data.remarks.missing;
        const labelsOf = indices => indices.map(index => data.machines[index].label).join(', ');
        const rows = list.map(item => [item.cell, labelsOf(item.on), item.lacking.map(([machine, why]) => `${data.machines[machine].label}: ${why}`).join('; ')]);
        const heads = [['configuration', 'break'], ['measured on'], ['missing on', 'break']];
        const first = 20;
        const place = element('div', {}, [table(heads, rows.slice(0, first))]);
        if (rows.length > first) put(place, element('details', {}, [element('summary', { textContent: plural(rows.length - first, 'more configuration') }), table(heads, rows.slice(first))]));
        return place;
    };
    return { hardware, ratios, claims, missing, agreementMark };
})();
