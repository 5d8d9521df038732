// Makes the elements of the page. All strings become text, never markup.
const pageKit = (() => {
    /// element('td', { className: 'number', textContent: '3' }, [children])
    const element = (tag, properties = {}, children = []) => {
        const made = document.createElement(tag);
        for (const [name, value] of Object.entries(properties)) {
            if (name === 'dataset') Object.assign(made.dataset, value);
            else if (name === 'attributes') for (const [key, text] of Object.entries(value)) made.setAttribute(key, text);
            else made[name] = value;
        }
        made.append(...children);
        return made;
    };
    /// An element of an SVG.
    const shape = (tag, attributes = {}) => {
        const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
        for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
        return made;
    };
    const put = (parent, ...children) => parent.append(...children);
    const paragraph = (text, className = '') => element('p', { textContent: text, className });
    const plural = (count, one, many) => `${count} ${count === 1 ? one : many || one + 's'}`;
    /// A head is [text, class of its column, name of the value where a narrow screen stacks the cells].
    const table = (heads, rows, className = '') => element('div', { className: 'table-scroll' }, [element('table', { className }, [
        element('thead', {}, [element('tr', {}, heads.map(([text, kind]) => element('th', { textContent: text, className: kind || '' })))]),
        element('tbody', {}, rows.map(row => element('tr', {}, row.map((cell, index) => {
            const td = element('td', { className: heads[index][1] || '', dataset: heads[index][2] ? { name: heads[index][2] } : {} });
            td.append(cell ?? '');
            return td;
        })))),
    ])]);
    const button = (text, action, properties = {}) => {
        const made = element('button', { type: 'button', textContent: text, ...properties });
        made.addEventListener('click', action);
        return made;
    };
    /// Saves a text or a data URL as a file.
    const download = (name, content, type) => {
        const url = type ? URL.createObjectURL(new Blob([content], { type })) : content;
        element('a', { href: url, download: name }).click();
        if (type) setTimeout(() => URL.revokeObjectURL(url), 10000);
    };
    /// RFC 4180.
    const csv = rows => rows.map(row => row.map(cell => {
        const text = cell === null || cell === undefined ? '' : String(cell);
        return /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
    }).join(',')).join('\n') + '\n';
    return { element, shape, put, paragraph, plural, table, button, download, csv };
})();
