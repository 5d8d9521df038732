// Charts on the page, each with its controls, its note, and buttons that save it as a picture or as numbers.
//
// chartCards(report, look) gives {add, drawAll, drawFirst}; `look` is {theme, hidden, paperWidth} and is read at each
// drawing. paperWidth, while the page is printed, is the width of the paper in pixels.
const chartCards = (report, look) => {
    const { element, put, paragraph, button, download, csv } = pageKit;
    const charts = [];

    // The tooltip of the point under the pointer.
    const tooltip = document.getElementById('tooltip');
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

    const valueFrom = (key, text) => (text === 'true' ? true : text === 'false' ? false : key === 'run' ? Number(text) : text);
    /// The choices that another choice resets: each quantity has its own scale.
    const dependent = { x: ['xLog'], column: ['yLog'], metric: ['yLog'], against: ['xLog'] };

    /// Buttons that save what `now()` gives: {view, built}.
    const saveButtons = (chart, now) => {
        const savers = {
            svg: async ({ view }) => download(`${chart.id}.svg`, await view.toSVG(), 'image/svg+xml'),
            png: async ({ view }) => download(`${chart.id}.png`, await view.toImageURL('png', 2)),
            csv: async ({ built }) => download(`${chart.id}.csv`, csv([built.table.columns.map(([name]) => name), ...built.table.rows]), 'text/csv'),
            json: async ({ built }) => download(`${chart.id}.json`, JSON.stringify({
                chart: chart.id, description: built.spec.description, state: built.state, columns: built.table.columns.map(([name, unit]) => ({ name, unit })), rows: built.table.rows,
            }, null, 1), 'application/json'),
        };
        return element('span', { className: 'save' }, Object.entries(savers).map(([ending, saver]) =>
            button(ending.toUpperCase(), () => now().view && saver(now()), { title: `save this chart as ${ending.toUpperCase()}`, className: `save-${ending}` })));
    };

    /// Each control is [key, label, [[value, text]…]] and sets that key of the chart.
    const add = (parent, chart, controls = []) => {
        const settings = Object.fromEntries(Object.entries(pageState.ofChart(chart.id)).map(([key, text]) => [key, valueFrom(key, text)]));
        const place = element('div', { className: 'chart', id: `chart-${chart.id}` });
        const note = paragraph('', 'note');
        const bar = element('div', { className: 'controls' });
        let view = null, built = null, drawnLast = Promise.resolve();
        const showState = state => {
            for (const select of bar.querySelectorAll('select')) {
                const { key } = select.dataset;
                if (key === 'world') {
                    const worlds = state.worlds || [];
                    if (worlds.join('\n') !== [...select.options].map(option => option.value).join('\n'))
                        select.replaceChildren(...worlds.map(world => new Option(world, world)));
                    select.parentElement.hidden = worlds.length < 2;
                }
                // Only curves have a choice of scales.
                if (key === 'xLog' || key === 'yLog') select.parentElement.hidden = state[key] === undefined;
                if (state[key] !== undefined) select.value = String(state[key]);
            }
        };
        const drawing = async () => {
            if (view) view.finalize();
            view = null;
            if (!place.clientWidth) return;  // in a folded part
            const width = look.paperWidth || Math.max(Math.floor(place.clientWidth), 260);
            built = chartKit.build(report, { ...chart, ...settings, width, theme: look.theme, hidden: look.hidden });
            const { spec, config, notes, empty, state } = built;
            place.replaceChildren();
            note.textContent = empty ? '' : notes.join(' ');
            if (empty) {
                put(place, paragraph(empty, 'empty'));
                return;
            }
            showState(state);
            view = new vega.View(vega.parse(spec, config, { ast: true }), {
                renderer: 'svg', container: place, hover: true, expr: vega.expressionInterpreter, tooltip: showTooltip, logLevel: vega.Warn,
            });
            await view.runAsync();
            place.querySelector('svg')?.setAttribute('aria-label', `${chart.id}: ${spec.description}`);
        };
        // One drawing after another, so that an older one never covers a newer one.
        const draw = () => (drawnLast = drawnLast.then(drawing));
        for (const [key, label, options] of controls) {
            if (options.length < 2 && key !== 'world') continue;
            const select = element('select', { dataset: { key } }, options.map(([value, text]) => new Option(text, value)));
            select.addEventListener('change', () => {
                settings[key] = valueFrom(key, select.value);
                pageState.set(`${chart.id}.${key}`, select.value);
                for (const other of dependent[key] || []) {
                    delete settings[other];
                    pageState.set(`${chart.id}.${other}`, '');
                }
                draw();
            });
            put(bar, element('label', { className: 'control' }, [element('span', { textContent: label }), select]));
        }
        put(bar, saveButtons(chart, () => ({ view, built })));
        put(parent, bar, place, note);
        charts.push({ draw, place });
    };
    const drawAll = () => Promise.all(charts.map(chart => chart.draw()));
    /// Draws one chart at a time, so that the page can be read and scrolled from the start.
    const drawFirst = async () => {
        for (const chart of charts) {
            await chart.draw();
            await new Promise(resolve => setTimeout(resolve));
        }
    };
    /// Draws the charts in a part that was folded.
    const drawWithin = part => Promise.all(charts.filter(chart => part.contains(chart.place)).map(chart => chart.draw()));
    return { add, drawAll, drawFirst, drawWithin };
};
