"""Those who mean a live server ill, in a process of their own: python -m tests.benchmarks.attackers
ADDRESS SECONDS

300 sockets that say nothing, ten pages that wish for large pictures and take nothing, three that
wish as fast as they can, three that send garbage. Prints "here" when all are, and each second what
was sent.
"""

import asyncio
import contextlib
import sys
import time

import numpy as np
import websockets

from tests.fake_page import FakePage


async def attack(address: str, seconds: float) -> None:
    """Attack a server for so long."""
    end = time.perf_counter() + seconds
    began = time.perf_counter()
    sent = {"wishes": 0, "garbage": 0}
    visitor = await FakePage(address, "?lesson=transforms").open()
    quiet = [await visitor.socket(f"live?token={i:024x}") for i in range(300)]

    async def taking_nothing() -> None:
        page = await FakePage(address, "?lesson=disparity").open(read=False)
        page.live.transport.pause_reading()
        while time.perf_counter() < end:
            with contextlib.suppress(TimeoutError, websockets.ConnectionClosed):
                await asyncio.wait_for(
                    page.say(verb="change", values={"seed": sent["wishes"] % 90}), 1.0
                )
            await asyncio.sleep(0.05)

    async def flooding() -> None:
        page = await FakePage(address, "?lesson=icp").open()
        while time.perf_counter() < end:
            with contextlib.suppress(TimeoutError):  # it is read no faster than one may wish
                async with asyncio.timeout(1.0):
                    for _ in range(1000):
                        await page.say(verb="change", values={"start_angle": sent["wishes"] % 180})
                        sent["wishes"] += 1
            await asyncio.sleep(0.05)

    async def garbage(seed: int) -> None:
        rng = np.random.default_rng(seed)
        while time.perf_counter() < end:
            page = await FakePage(address, "?lesson=ransac").open()
            with contextlib.suppress(websockets.ConnectionClosed, TimeoutError):
                async with asyncio.timeout(2.0):
                    while True:
                        await page.live.send(rng.bytes(int(rng.integers(1, 3000))))
                        await page.live.send("[" * int(rng.integers(1, 9000)))
                        sent["garbage"] += 2
                        await asyncio.sleep(0.002)
            await page.close()

    async def telling() -> None:
        print("here", flush=True)
        while time.perf_counter() < end:
            await asyncio.sleep(1.0)
            for_ = time.perf_counter() - began
            print(
                ", ".join(f"{count / for_:,.0f} {kind} a second" for kind, count in sent.items()),
                flush=True,
            )

    await asyncio.gather(
        telling(),
        *(taking_nothing() for _ in range(10)),
        *(flooding() for _ in range(3)),
        *(garbage(i) for i in range(3)),
    )
    await asyncio.gather(*(socket.close() for socket in quiet))


if __name__ == "__main__":
    asyncio.run(attack(sys.argv[1], float(sys.argv[2])))
