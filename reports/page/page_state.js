// The reader's choices in the page's address, so that a link shows the same view: `#claims?theme=dark&hidden=billboard&
// carr2006-fig5.column=gpu_bytes`, which is an anchor followed by the choices.
const pageState = (() => {
    const parts = () => {
        const [anchor, query = ''] = window.location.hash.slice(1).split('?');
        return { anchor: decodeURIComponent(anchor), values: new URLSearchParams(query) };
    };
    const { values } = parts();
    const write = anchor => {
        const query = values.toString();
        window.history.replaceState(null, '', `#${encodeURIComponent(anchor)}${query ? '?' + query : ''}`);
    };
    const get = (key, otherwise = '') => values.get(key) ?? otherwise;
    /// An empty value removes the choice.
    const set = (key, value) => {
        if (value === '') values.delete(key);
        else values.set(key, value);
        write(parts().anchor);
    };
    /// A link within the page changes the anchor and keeps the choices.
    window.addEventListener('hashchange', () => {
        if (window.location.hash.includes('?')) window.location.reload();
        else write(parts().anchor);
    });
    /// All choices of a chart: `carr2006-fig5.column` is its `column`.
    const ofChart = id => Object.fromEntries([...values].filter(([key]) => key.startsWith(`${id}.`)).map(([key, value]) => [key.slice(id.length + 1), value]));
    const scrollToAnchor = () => {
        const { anchor } = parts();
        if (window.location.hash.includes('?') && anchor) document.getElementById(anchor)?.scrollIntoView();
    };
    return { get, set, ofChart, scrollToAnchor };
})();
