// The table of all methods at all loads, which a reader can sort and filter.
const overview = (() => {
    const { element, put, button } = pageKit;
    const { digits, shownOf, columnOf, variantOf, worldOf } = chartKit;
    /// Cost, quality and the flaws that metrics declare.
    const wantedIn = ({ columns }) => ['fps_avg', 'method_ms_median', 'psnr_db', ...Object.keys(columns).filter(name => columns[name].flaw)];
    const firstRows = 12;

    const valuesOf = (cell, wanted) => Object.fromEntries(wanted.map(name => [name, chartData.valueOf(cell, name)?.[0] ?? null]));
    /// A row for each configuration with any of these numbers, its seeds combined. The null method, which draws nothing, is
    /// left out.
    const rowsOf = (report, experiments, titleOf) => experiments.flatMap(whole => {
        const experiment = shownOf(whole);
        return chartData.inOrder(experiment, experiment.cells.filter(cell => cell.method !== chartStyle.baseline && cell.runs.length)).map(cell => ({
            experiment, title: titleOf(whole), variant: variantOf(report, experiment, cell), world: worldOf(experiment, cell) || '–', method: cell.method, values: valuesOf(cell, wantedIn(report)),
        })).filter(row => Object.values(row.values).some(value => value !== null));
    });
    const unitText = unit => (unit.startsWith('share') ? '%' : ['encoded value', 'linear light', 'parts', 'alpha/pixel', '1/pixel'].includes(unit) ? '' : unit);
    const headOf = (report, name) => {
        const { name: text, unit } = columnOf(report, name);
        return text + (unitText(unit) ? ` [${unitText(unit)}]` : '');
    };
    /// Texts with numbers sort by the numbers. Missing values come last in either direction.
    const compared = (a, b, key, down) => {
        const [left, right] = [a, b].map(row => (key in row.values ? row.values[key] : key === 'experiment' ? row.experiment.id : row[key]));
        if (left === null || right === null) return (left === null) - (right === null);
        const order = typeof left === 'number' ? left - right : left.localeCompare(right, 'en', { numeric: true });
        return down ? -order : order;
    };

    const build = (report, experiments, titleOf, colourOf) => {
        const all = rowsOf(report, experiments, titleOf);
        const columns = wantedIn(report).filter(name => all.some(row => row.values[name] !== null));
        // The rows with the most values come first.
        const filled = row => columns.filter(name => row.values[name] !== null).length;
        all.sort((a, b) => filled(b) - filled(a));
        const heads = [['variant', 'method'], ['world', 'load'], ...columns.map(name => [name, headOf(report, name)]), ['experiment', 'experiment']];
        let [sort, down] = [pageState.get('sort').replace(/^-/, ''), pageState.get('sort').startsWith('-')];
        let whole = false, onPaper = false;
        const filter = element('input', { type: 'search', placeholder: 'octree particles 2000 …', value: pageState.get('filter'), className: 'filter', ariaLabel: 'show rows that contain these words' });
        const body = element('tbody'), headRow = element('tr'), note = element('p', { className: 'note' });
        const more = button('', () => { whole = !whole; show(); }, { className: 'more-rows' });
        const cellOf = (row, name) => {
            const { unit } = columnOf(report, name);
            const value = row.values[name];
            return element('td', { className: 'number', textContent: value === null ? '' : digits(chartData.shown(value, unit)) });
        };
        const show = () => {
            const asked = chartData.sized(filter.value.toLowerCase()).split(/\s+/).filter(Boolean);
            const kept = all.filter(row => asked.every(word => `${row.variant} ${row.world} ${row.title} ${row.experiment.id}`.toLowerCase().includes(word)));
            if (sort) kept.sort((a, b) => compared(a, b, sort, down));
            const shown = whole ? kept : kept.slice(0, firstRows);
            body.replaceChildren(...shown.map(row => element('tr', {}, [
                element('td', { className: 'method' }, [element('span', { className: 'dot', style: `--colour: ${colourOf(row.method)}`, dataset: { method: row.method } }), chartData.tied(row.variant)]),
                element('td', { textContent: chartData.tied(row.world) }),
                ...columns.map(name => cellOf(row, name)),
                element('td', {}, [element('a', { href: `#experiment-${row.experiment.id}`, textContent: row.experiment.id })]),
            ])));
            headRow.replaceChildren(...heads.map(([key, text]) => {
                const isSorted = key === sort;
                const head = element('th', { className: columns.includes(key) ? 'number' : '', ariaSort: isSorted ? (down ? 'descending' : 'ascending') : 'none' });
                const mark = isSorted ? (down ? ' ↓' : ' ↑') : '';
                // Browsers repeat a table head on each printed page only if it contains no buttons.
                put(head, onPaper ? text + mark : button(text + mark, () => {
                    down = isSorted ? !down : columnOf(report, key).better === 'high';
                    sort = key;
                    pageState.set('sort', (down ? '-' : '') + sort);
                    show();
                }, { className: 'sort', dataset: { key } }));
                return head;
            }));
            more.hidden = kept.length <= firstRows;
            more.textContent = whole ? 'Show fewer' : `Show all ${kept.length}`;
            note.textContent = `${shown.length} of ${all.length} rows shown. Medians over repetitions and seeds; empty: not measured.`;
        };
        filter.addEventListener('input', () => {
            pageState.set('filter', filter.value);
            show();
        });
        // Printed pages show all rows, because they have no button.
        let before = false;
        window.addEventListener('beforeprint', () => { before = whole; whole = onPaper = true; show(); });
        window.addEventListener('afterprint', () => { whole = before; onPaper = false; show(); });
        show();
        return element('article', { className: 'card overview' }, [
            element('div', { className: 'controls' }, [element('label', { className: 'control' }, [element('span', { textContent: 'Filter' }), filter])]),
            element('div', { className: 'table-scroll' }, [element('table', {}, [element('thead', {}, [headRow]), body])]), more, note,
        ]);
    };
    return { build, rowsOf };
})();
