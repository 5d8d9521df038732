// Shows documents of the source tree in Markdown: headings, paragraphs, lists, tables, code and emphasis.
const markdown = (() => {
    const { element, put } = pageKit;
    const idOf = (prefix, text) => `${prefix}-${text.toLowerCase().replace(/[^\w\- ]/g, '').replace(/ /g, '-')}`;

    /// Links to headings of this document are links. Those to other files of the source tree become text.
    const inline = (prefix, text) => {
        const pattern = /`([^`]+)`|\*\*([^*]+)\*\*|\*([^*\s][^*]*)\*|\[([^\]]+)\]\(([^)]*)\)|\\(.)/g;
        const parts = [];
        let at = 0;
        for (const match of text.matchAll(pattern)) {
            parts.push(text.slice(at, match.index));
            at = match.index + match[0].length;
            const [, code, strong, soft, link, target, escaped] = match;
            if (code !== undefined) parts.push(element('code', { textContent: code }));
            else if (strong !== undefined) parts.push(element('b', {}, inline(prefix, strong)));
            else if (soft !== undefined) parts.push(element('i', {}, inline(prefix, soft)));
            else if (escaped !== undefined) parts.push(escaped);
            else if (target.startsWith('#')) parts.push(element('a', { href: `#${prefix}-${target.slice(1)}` }, inline(prefix, link)));
            else parts.push(...inline(prefix, link));
        }
        parts.push(text.slice(at));
        return parts.filter(part => part !== '');
    };
    const cellsIn = line => line.trim().replace(/^\||\|$/g, '').split(/(?<!\\)\|/).map(cell => cell.trim());
    const tableOf = (prefix, lines) => {
        const [heads, , ...rows] = lines.map(cellsIn);
        const row = (tag, cells) => element('tr', {}, cells.map(cell => element(tag, {}, inline(prefix, cell))));
        return element('div', { className: 'table-scroll' }, [element('table', {}, [
            element('thead', {}, [row('th', heads)]), element('tbody', {}, rows.map(cells => row('td', cells))),
        ])]);
    };
    const isBlank = line => !line.trim();
    const starts = { table: /^\s*\|/, item: /^\s*[-*] /, code: /^ {4}\S/, heading: /^(#+) (.*)/, fence: /^```/ };

    /// `prefix` precedes the ids of headings, so that several documents can share a page.
    const show = (text, prefix) => {
        const lines = text.split('\n');
        const whole = element('div', { className: 'document' });
        const run = (from, test) => {
            let end = from;
            while (end < lines.length && test(lines[end])) ++end;
            return end;
        };
        const isPlain = line => !isBlank(line) && !Object.values(starts).some(start => start.test(line));
        for (let at = 0; at < lines.length;) {
            const line = lines[at];
            let end = at + 1;
            if (starts.fence.test(line)) {
                end = run(at + 1, other => !starts.fence.test(other)) + 1;
                put(whole, element('pre', { textContent: lines.slice(at + 1, end - 1).join('\n') }));
            } else if (starts.heading.test(line)) {
                const [, marks, title] = line.match(starts.heading);
                if (marks.length > 1) put(whole, element(`h${Math.min(marks.length + 2, 6)}`, { id: idOf(prefix, title) }, inline(prefix, title)));
            } else if (starts.table.test(line)) {
                end = run(at, other => starts.table.test(other));
                put(whole, tableOf(prefix, lines.slice(at, end)));
            } else if (starts.item.test(line)) {
                end = run(at, other => starts.item.test(other) || (/^\s+\S/.test(other) && !isBlank(other)));
                const items = lines.slice(at, end).reduce((list, other) => (starts.item.test(other) ? [...list, other.replace(starts.item, '')]
                    : [...list.slice(0, -1), `${list[list.length - 1]} ${other.trim()}`]), []);
                put(whole, element('ul', {}, items.map(item => element('li', {}, inline(prefix, item)))));
            } else if (starts.code.test(line)) {
                end = run(at, other => starts.code.test(other) || /^ {4}/.test(other));
                put(whole, element('pre', { textContent: lines.slice(at, end).map(other => other.slice(4)).join('\n') }));
            } else if (!isBlank(line)) {
                end = run(at, isPlain);
                put(whole, element('p', {}, inline(prefix, lines.slice(at, end).join(' '))));
            }
            at = Math.max(end, at + 1);
        }
        return whole;
    };
    return { show };
})();
