// The viewer of pictures: any two of a world at a frame, by a slider, in turns, or side by side.
const pictureViewer = (() => {
    const make = (tag, properties = {}, children = []) => {
        const element = Object.assign(document.createElement(tag), properties);
        element.append(...children);
        return element;
    };
    const nameOf = picture => (picture.difference ? `difference: ${picture.label}` : picture.label);
    const secondsPerTurn = 0.7;

    const build = (report, titleOf) => {
        // Worlds with an exact picture first: they say most.
        const isJudged = set => set.pictures.some(picture => picture.label === 'exact');
        const sets = [...report.data.pictures].sort((a, b) => isJudged(b) - isJudged(a));
        const worlds = [...new Map(sets.map(set => [`${set.experiment}\n${set.world}`, set])).values()];
        const choice = (label, className) => {
            const select = make('select', { className });
            return [select, make('label', { className: 'control' }, [make('span', { textContent: label }), select])];
        };
        const [world, worldControl] = choice('World', 'world');
        const [left, leftControl] = choice('Left', 'left');
        const [right, rightControl] = choice('Right', 'right');
        const [mode, modeControl] = choice('View', 'mode');
        const frame = make('input', { type: 'range', min: 0, value: 0, className: 'frame' });
        const frameText = make('output', { className: 'frame-text' });
        const frameControl = make('label', { className: 'control' }, [make('span', { textContent: 'Frame' }), frame, frameText]);
        worlds.forEach((set, index) => world.append(new Option([titleOf(set.experiment), set.world].filter(Boolean).join(' · '), index)));
        for (const [value, text] of [['slider', 'slider'], ['flicker', 'alternating'], ['both', 'side by side']]) mode.append(new Option(text, value));

        const [leftImage, rightImage] = ['left-image', 'right-image'].map(className => make('img', { className, decoding: 'sync' }));
        const [leftName, rightName] = ['left-name', 'right-name'].map(className => make('figcaption', { className }));
        const line = make('div', { className: 'divider' });
        const slider = make('input', { type: 'range', min: 0, max: 1000, value: 500, className: 'wipe', ariaLabel: 'edge of the left picture' });
        const stage = make('div', { className: 'picture-stage' }, [leftImage, rightImage, line, leftName, rightName]);
        const place = make('div', { className: 'picture-viewer' }, [
            make('div', { className: 'controls' }, [worldControl, frameControl, leftControl, rightControl, modeControl]), stage, slider,
        ]);

        let timer = null;
        const framesHere = () => sets.filter(set => set.experiment === worlds[world.value].experiment && set.world === worlds[world.value].world)
            .sort((a, b) => a.frame - b.frame);
        const setNow = () => framesHere()[frame.value];
        const showWipe = () => {
            const share = slider.value / 10;
            const sliding = mode.value === 'slider';
            rightImage.style.clipPath = sliding ? `inset(0 0 0 ${share}%)` : '';
            line.style.left = `${share}%`;
            line.hidden = slider.hidden = !sliding;
        };
        const showMode = () => {
            clearInterval(timer);
            rightImage.style.visibility = rightName.style.visibility = leftName.style.visibility = '';
            stage.classList.toggle('both', mode.value === 'both');
            stage.classList.toggle('turns', mode.value === 'flicker');
            if (mode.value === 'flicker') {
                let onTop = true;
                const turn = () => {
                    onTop = !onTop;
                    rightImage.style.visibility = rightName.style.visibility = onTop ? '' : 'hidden';
                    leftName.style.visibility = onTop ? 'hidden' : '';
                };
                turn();
                timer = setInterval(turn, secondsPerTurn * 1000);
            }
            showWipe();
        };
        const showPictures = () => {
            const set = setNow();
            const [a, b] = [set.pictures[left.value], set.pictures[right.value]];
            [[leftImage, leftName, a], [rightImage, rightName, b]].forEach(([image, caption, picture]) => {
                image.src = picture.source;
                image.alt = caption.textContent = nameOf(picture);
                if (set.width) [image.width, image.height] = [set.width, set.height];
            });
            // Little pixels are magnified, but not to bricks.
            stage.style.setProperty('--widest', `${set.width ? Math.min(960, Math.max(2 * set.width, 480)) : 960}px`);
            frameText.textContent = set.frame;
        };
        /// The same names stay chosen from frame to frame and from world to world.
        const showNames = () => {
            const names = setNow().pictures.map(nameOf);
            const pick = (select, otherwise) => {
                const before = select.selectedOptions[0]?.text;
                select.replaceChildren(...names.map((name, index) => new Option(name, index)));
                select.value = Math.max(names.includes(before) ? names.indexOf(before) : otherwise, 0);
            };
            const exact = names.indexOf('exact');
            pick(left, exact);
            pick(right, names.findIndex((name, index) => index !== Math.max(exact, 0)));
            showPictures();
        };
        const showWorld = () => {
            const frames = framesHere();
            frame.max = frames.length - 1;
            frame.value = Math.min(frame.value, frames.length - 1);
            frameControl.hidden = frames.length < 2;
            showNames();
        };
        world.addEventListener('change', showWorld);
        frame.addEventListener('input', showNames);
        left.addEventListener('change', showPictures);
        right.addEventListener('change', showPictures);
        mode.addEventListener('change', showMode);
        slider.addEventListener('input', showWipe);
        showWorld();
        showMode();
        return place;
    };
    return { build };
})();
