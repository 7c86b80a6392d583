"""What is sent of an answer's body: nothing to who asks for the head alone."""

from __future__ import annotations

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from checker.base.record import Record


class Heads(Record):
    """Answers HEAD as GET at every address, without the body (RFC 9110, 9.3.2)."""

    app: ASGIApp

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http" or scope["method"] != "HEAD":
            await self.app(scope, receive, send)
            return

        async def head_alone(message: Message) -> None:
            if message["type"] == "http.response.start":
                await send(message)
                # Now the answer has ended, and what sends a long body is told that nobody reads on.
                await send({"type": "http.response.body"})

        # What routes write into the scope is for those around as well.
        scope["method"] = "GET"
        try:
            await self.app(scope, receive, head_alone)
        finally:
            scope["method"] = "HEAD"
