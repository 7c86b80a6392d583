"""An upload form while it comes in: its file is passed on as it comes."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from unicodedata import normalize

from multipart import MultipartError, MultipartSegment, PushMultipartParser, parse_options_header

from checker.package.formats import single_file_suffixes
from checker.package.inputs import ARCHIVE_SUFFIXES
from checker.package.no_package import reason_not_checked
from checker.service.web.answers.refusal import Refused, sentence

# Names that clients send, made safe; they are shown and give the kind, and never become paths.


SUFFIXES = (*ARCHIVE_SUFFIXES, *single_file_suffixes())
LENGTH_LIMIT = 100
_UNSAFE = re.compile(r"[^\w.-]+")
_NAMELESS = "upload"


class UnknownKind(ValueError):
    """File name of a kind that cannot be checked; the text is one sentence.

    Attributes:
        advice: What to send, one sentence.
    """

    def __init__(self, name: str) -> None:
        reason, advice = reason_not_checked(name)
        known = ", ".join(SUFFIXES[:-1])
        ends = f"its name does not end in {known} or {SUFFIXES[-1]}"
        super().__init__(f"the file {reason}: {ends}")
        self.advice = sentence(advice)


def safe_name(name: str) -> str:
    """Return a file name of letters, digits, `-`, `_` and `.`, of at most 100 bytes.

    Letters of all languages are kept.

    Args:
        name: The name as the client states it: a name, or a path as some browsers send it.

    Raises:
        UnknownKind: Its ending is of no archive and no model file.
    """
    base = normalize("NFC", re.split(r"[/\\]", name)[-1].strip())
    suffix = next((ending for ending in SUFFIXES if base.lower().endswith(ending)), None)
    if suffix is None:
        raise UnknownKind(base)
    stem = _UNSAFE.sub("_", base[: -len(suffix)]).strip("._-")
    short = stem.encode()[: LENGTH_LIMIT - len(suffix)].decode(errors="ignore")
    return (short.rstrip("._-") or _NAMELESS) + suffix


FILE = "file"
FIELD_LIMIT = 1_000
"""Bytes of each other field."""
PARTS_LIMIT = 8
ROOM = 65_536
"""Bytes of a form around its file."""
HEAD = 512
"""Bytes of a file that are enough to check whether they fit its name."""
_ZIP = (b"PK\x03\x04", b"PK\x05\x06")
_GZIP = b"\x1f\x8b"
_UTF8_MARK = b"\xef\xbb\xbf"
_UTF16_TAG = (b"\xff\xfe<\0", b"\xfe\xff\0<")
_WHAT_TO_SEND = "Send a .zip or .tar.gz archive of the package folder, or a model file."
_HOW_TO_SEND = "Send a multipart form with one field 'file' that contains the file."


class UploadForm:
    """Takes a form piece by piece, and refuses it as soon as something is wrong with it.

    Attributes:
        name: The name of the file, made safe; empty before it comes.
        fields: The other fields so far.
    """

    def __init__(
        self,
        content_type: str,
        write: Callable[[bytes], object],
        admit: Callable[[Mapping[str, str]], None],
    ) -> None:
        """Begin.

        Args:
            content_type: The type of the request.
            write: Takes the next bytes of the file.
            admit: Called with the fields so far when the file begins; refuses those without
                permission.

        Raises:
            Refused: The request is no such form.
        """
        self.name = ""
        self.fields: dict[str, str] = {}
        self._write_file, self._admit = write, admit
        self._parser = _parser(content_type)
        self._field: str | None = None
        self._text = bytearray()
        self._head: bytearray | None = bytearray()

    def feed(self, piece: bytes) -> None:
        """Take the next bytes of the request, at least one.

        Raises:
            Refused: The form is damaged, or holds what is not taken.
            Exception: What `write` raises.
        """
        try:
            if not self._parser.closed:
                for event in self._parser.parse(piece):
                    self._take(event)
        except MultipartError as error:
            # What follows the first word of it are the client's own bytes.
            raise _damaged(str(error.args[0])) from None

    def end(self) -> None:
        """Take note that all has come.

        Raises:
            Refused: It is not a whole form, or no file is in it.
        """
        try:
            self._parser.close()
        except MultipartError:
            raise _damaged("it ends early") from None
        if not self.name:
            raise Refused(422, "The form contains no file.", _HOW_TO_SEND, "no file")

    def _take(self, event: MultipartSegment | bytes | bytearray | None) -> None:
        if isinstance(event, MultipartSegment):
            self._begin(event.name or "", event.filename)
        elif event is None:
            self._finish()
        elif self._field == FILE:
            self._write(bytes(event))
        elif len(self._text) + len(event) <= FIELD_LIMIT:
            self._text += event
        else:
            message = f"A field of the form is longer than {FIELD_LIMIT} bytes."
            raise Refused(400, message, _HOW_TO_SEND, "form")

    def _begin(self, field: str, filename: str | None) -> None:
        self._field, self._text = field, bytearray()
        if field != FILE:
            if filename is not None:
                raise Refused(400, "A file is in another field.", _HOW_TO_SEND, "form")
            return
        if self.name:
            raise Refused(400, "The form contains more than one file.", _HOW_TO_SEND, "form")
        if not filename:
            raise Refused(422, "No file is chosen.", _WHAT_TO_SEND, "no file")
        self._admit(self.fields)
        try:
            self.name = safe_name(filename)
        except UnknownKind as error:
            raise Refused(415, sentence(str(error)), error.advice, "kind") from None

    def _write(self, piece: bytes) -> None:
        """Hold the first bytes back until they are enough to identify the kind."""
        if self._head is not None:
            self._head += piece
            if len(self._head) < HEAD:
                return
            piece = self._checked_head()
        self._write_file(piece)

    def _checked_head(self) -> bytes:
        head, self._head = bytes(self._head or b""), None
        if not head:
            raise Refused(422, f"{self.name} is empty.", _WHAT_TO_SEND, "no file")
        if expected := signature_mismatch(self.name, head[:HEAD]):
            message = f"{self.name} has the name of {expected}, but not its content."
            raise Refused(415, message, _WHAT_TO_SEND, "kind")
        return head

    def _finish(self) -> None:
        if self._field == FILE:
            if self._head is not None:
                self._write_file(self._checked_head())
        elif self._field is not None:
            self.fields[self._field[:FIELD_LIMIT]] = self._text.decode("utf-8", "replace")
        self._field = None


def _parser(content_type: str) -> PushMultipartParser:
    kind, options = parse_options_header(content_type)
    if kind != "multipart/form-data":
        raise Refused(415, "The request contains no upload form.", _HOW_TO_SEND, "form")
    try:
        return PushMultipartParser(options.get("boundary", ""), max_segment_count=PARTS_LIMIT)
    except (MultipartError, UnicodeEncodeError) as error:
        raise _damaged(str(error)) from None


def _damaged(why: str) -> Refused:
    reason = why[:1].lower() + why[1:]
    return Refused(400, f"The upload form cannot be read: {reason}.", _HOW_TO_SEND, "form")


def signature_mismatch(name: str, head: bytes) -> str:
    """Return what the file should begin with and does not; empty if it does.

    Args:
        name: The name of the file, with an ending that is known.
        head: Its first `HEAD` bytes, or all of them.
    """
    lower = name.lower()
    if lower.endswith(".zip"):
        return "" if head.startswith(_ZIP) else "a zip archive"
    if lower.endswith((".gz", ".tgz")):
        return "" if head.startswith(_GZIP) else "a gzipped tar archive"
    return "" if _is_xml(head) else "an XML text"


def _is_xml(head: bytes) -> bool:
    """Return whether a tag, a comment or a declaration comes first."""
    return head.removeprefix(_UTF8_MARK).lstrip().startswith(b"<") or head.startswith(_UTF16_TAG)
