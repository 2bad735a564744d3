"""A reader who goes through a story in any order, by a seed; and what must hold wherever she
rests.
"""

import random
from collections.abc import Callable, Mapping
from typing import Any

ACTS: Mapping[str, str] = {
    "read on": "scrollBy({ top: innerHeight * %f, behavior: 'instant' })",
    "read back": "scrollBy({ top: -innerHeight * %f, behavior: 'instant' })",
    "fly": "scrollTo({ top: document.documentElement.scrollHeight * %f, behavior: 'instant' })",
    "next scene": "story.key(new KeyboardEvent('keydown', { key: ']' }))",
    "scene before": "story.key(new KeyboardEvent('keydown', { key: '[' }))",
    "next step": "story.act('next')",
    "step back": "story.act('back')",
    "play": "story.act('play')",
    "back to the text": "story.key(new KeyboardEvent('keydown', { key: 'b' }))",
    "slider": "story.step(Math.floor(%f * Number($('#step').max)))",
    "link": "chosen('#story a[data-go]', %f)?.click()",
    "pick": "chosen('#story .pick', %f)?.click()",
    "number": "turned(chosen('#story .num[role=slider]', %f))",
    "question": "chosen('#story .ask:not(.asked) [data-skip]', %f)?.click()",
    "both faces": "story.turn('bench'); story.turn('story')",
    "back": "history.back()",
}
"""What she does -> the expression that does it, with a place from 0 to 1 where it needs one."""
HELPERS = """
window.chosen = (selector, at) => {
  const seen = $$(selector).filter((one) => {
    const { top, bottom } = one.getBoundingClientRect();
    return one.getClientRects().length && bottom > story.top() && top < innerHeight;
  });
  return seen[Math.floor(at * seen.length)];
};
window.turned = (number) => number?.dispatchEvent(new KeyboardEvent("keydown",
  { key: Math.random() < 0.5 ? "ArrowRight" : "PageDown", bubbles: true }));
window.apart = () => {
  const { place } = storyStage, { run } = page;
  if (page.face !== "story") {  // she went back to it, and comes again
    story.turn("story");
    return "the workbench was open";
  }
  if (story.flying || transport.playing) return "on the way";
  if ($(".ask.asked:not(.done)")) return "an answer is played";
  if (!story.here || story.read() !== story.here) return "other words are read";
  if (story.scene !== story.here.scene) return "another scene";
  if (!run || !storyStage.is(run, place)) return `run ${run?.name}, not ${place?.run}`;
  const k = storyStage.found(run, place.step);
  if (page.k !== k) return `step ${page.k}, not ${k}`;
  if ($("#caption").textContent !== run.steps[k]?.caption) return "another caption";
  if ($("#back").hidden === story.hand) return "the button does not say whose the stage is";
  const said = story.placeAt(story.here.el);
  if (!story.hand &&
    (canonical(said.run) !== canonical(place.run) || String(own(said.step)) !== String(place.step)))
    return `the text's stage is at ${place.run} ${place.step}, its words at ${said.run} ${said.step}`;
  if (JSON.stringify(sceneView.hide) !== JSON.stringify(place.hide ?? [])) return "hidden things";
  return "";
};
"""


def walk(page: Any, seed: int, acts: int, *, told: Callable[[str], None] = lambda _: None) -> None:
    """Walk through the story that is open, and look after each act whether stage and words
    belong together.
    """
    chance = random.Random(seed)
    page.evaluate(HELPERS)
    for k in range(acts):
        act = chance.choice([*ACTS])
        if act == "back" and page.evaluate("history.length") < 3 + k // 4:
            act = "next scene"
        text = ACTS[act]
        told(f"{seed}: {act}")
        text = text % chance.random() if "%f" in text else text
        page.evaluate(f"() => {{ {text}; }}")  # she does not wait for what it promises
        if chance.random() < 0.25:  # she does not wait
            continue
        rests(page, f"walk {seed}, act {k}, {act}")
    rests(page, f"walk {seed}, at the end")


def rests(page: Any, where: str) -> None:
    """Wait until stage and words belong together, or say how they are apart."""
    try:
        page.wait_for_function("apart() === ''", timeout=30_000)
    except Exception as error:
        raise AssertionError(f"{where}: {page.evaluate('apart()')}") from error
