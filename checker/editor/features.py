"""Features of the language server protocol, and the function for each."""

from __future__ import annotations

import gc
import os
import sys

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from checker.editor import actions, commands
from checker.editor.assistance import completions, hover
from checker.editor.documents import open_document
from checker.editor.lenses import lenses_of
from checker.editor.navigation import Navigator, folds, outline
from checker.editor.server import Server, real_folders
from checker.package.walk import SKIPPED_FOLDERS

_WATCHED = [lsp.FileSystemWatcher(glob_pattern="**/*")]


def serve() -> None:
    """Serve an editor by standard input and output until it ends the server."""
    server = Server()
    register(server)
    # What a library prints must not end up among the words of the protocol.
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(sys.stderr.fileno(), 1)
    gc.disable()
    try:
        server.start_io(stdout=output)
    finally:
        server.end()


def register(server: Server) -> None:
    """Add all features to a server."""
    _follow_client(server)
    _follow_documents(server)
    _add_actions(server)
    _add_lenses(server)
    _add_names(server)
    _add_outlines(server)
    _add_assistance(server)
    commands.register(server)


def _follow_client(server: Server) -> None:
    @server.feature(lsp.INITIALIZE)
    def _(params: lsp.InitializeParams) -> None:
        server.begin(params)

    @server.feature(lsp.INITIALIZED)
    def _(_: lsp.InitializedParams) -> None:
        workspace = server.client_capabilities.workspace
        watching = workspace.did_change_watched_files if workspace else None
        if watching is not None and watching.dynamic_registration:
            options = lsp.DidChangeWatchedFilesRegistrationOptions(_WATCHED)
            name = lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES
            wanted = lsp.Registration("watched-files", name, options)
            server.client_register_capability(lsp.RegistrationParams([wanted]))

    @server.feature(lsp.WORKSPACE_DID_CHANGE_CONFIGURATION)
    def _(params: lsp.DidChangeConfigurationParams) -> None:
        settings = params.settings
        server.configure(settings.get("subt-check") if isinstance(settings, dict) else None)

    @server.feature(lsp.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS)
    def _(_: lsp.DidChangeWorkspaceFoldersParams) -> None:
        folders = real_folders(server.workspace.folders)

        def taken() -> None:
            server.session.units.folders = folders
            server.session.forget()

        server.reread(taken)

    @server.feature(lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def _(params: lsp.DidChangeWatchedFilesParams) -> None:
        # git writes its own files all the time; no package is read from there.
        steps = [change.uri.split("/") for change in params.changes]
        if any(it[-1][:1] != "." and SKIPPED_FOLDERS.isdisjoint(it) for it in steps):
            server.reread(server.session.forget)


def _follow_documents(server: Server) -> None:
    session = server.session

    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def _(params: lsp.DidOpenTextDocumentParams) -> None:
        item = params.text_document
        document = open_document(item.uri, item.version, item.text)
        if document is not None:
            session.documents[item.uri] = document
            server.check_soon()

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def _(params: lsp.DidChangeTextDocumentParams) -> None:
        document = session.documents.get(params.text_document.uri)
        if document is not None and params.content_changes:
            text = params.content_changes[-1].text
            changed = document.with_text(text, params.text_document.version)
            session.documents[document.uri] = changed
            server.check_soon()

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    async def _(params: lsp.DidSaveTextDocumentParams) -> None:
        server.reread(session.forget)
        if server.measures_on_save:
            await commands.measure(server, params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def _(params: lsp.DidCloseTextDocumentParams) -> None:
        uri = params.text_document.uri
        if session.documents.pop(uri, None) is not None:
            server.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, []))
            server.check_soon()


def _add_actions(server: Server) -> None:
    kinds = [lsp.CodeActionKind.QuickFix, lsp.CodeActionKind.SourceFixAll, actions.FIX_ALL]

    @server.feature(lsp.TEXT_DOCUMENT_CODE_ACTION, lsp.CodeActionOptions(kinds))
    async def _(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        known = await server.state_of(params.text_document.uri)
        if known is None:
            return []
        return await server.read(lambda: actions.code_actions(server, *known, params.context))


def _add_lenses(server: Server) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_CODE_LENS)
    async def _(params: lsp.CodeLensParams) -> list[lsp.CodeLens]:
        known = await server.state_of(params.text_document.uri)
        if known is None:
            return []
        return await server.read(lambda: lenses_of(*known, server.columns))


def _add_names(server: Server) -> None:
    async def navigator(uri: str) -> Navigator | None:
        known = await server.state_of(uri)
        if known is None:
            return None
        document, state = known
        index = await server.read(lambda: server.session.names(state))
        return Navigator(index, document, server.columns) if index is not None else None

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    async def _(params: lsp.DefinitionParams) -> list[lsp.Location]:
        names = await navigator(params.text_document.uri)
        return await server.read(lambda: names.definitions(params.position)) if names else []

    @server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    async def _(params: lsp.ReferenceParams) -> list[lsp.Location]:
        names = await navigator(params.text_document.uri)
        made = params.context.include_declaration
        if names is None:
            return []
        return await server.read(lambda: names.references(params.position, definitions=made))

    @server.feature(lsp.TEXT_DOCUMENT_PREPARE_RENAME)
    async def _(params: lsp.PrepareRenameParams) -> lsp.Range | None:
        names = await navigator(params.text_document.uri)
        return await server.read(lambda: names.range(params.position)) if names else None

    @server.feature(lsp.TEXT_DOCUMENT_RENAME, lsp.RenameOptions(prepare_provider=True))
    async def _(params: lsp.RenameParams) -> lsp.WorkspaceEdit:
        names = await navigator(params.text_document.uri)
        if names is None:
            raise refusal("the file is not part of a package that can be read")
        documents = list(server.session.documents.values())
        new = params.new_name
        done = await server.read(lambda: names.rename(params.position, new, documents))
        if isinstance(done, str):
            raise refusal(done)
        return done


def refusal(reason: str) -> JsonRpcException:
    """Return the answer that an editor shows as the reason why it cannot do something."""
    return JsonRpcException(f"cannot rename: {reason}", lsp.LSPErrorCodes.RequestFailed)


def _add_outlines(server: Server) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    async def _(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        known = await server.state_of(params.text_document.uri)
        if known is None or known[1].checked is None:
            return []
        document, checked = known[0], known[1].checked

        def outlined() -> list[lsp.DocumentSymbol]:
            package = server.session.legible(checked).package
            return outline(package, document, server.columns)

        return await server.read(outlined)

    @server.feature(lsp.TEXT_DOCUMENT_FOLDING_RANGE)
    def _(params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
        document = server.session.documents.get(params.text_document.uri)
        return folds(document) if document is not None and document.is_xml else []


def _add_assistance(server: Server) -> None:
    session = server.session

    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    async def _(params: lsp.HoverParams) -> lsp.Hover | None:
        known = await server.state_of(params.text_document.uri)
        if known is None or known[1].checked is None:
            return None
        state, columns, at = known[1], server.columns, params.position
        return await server.read(lambda: hover(session, known[0], state, at, columns))

    triggers = ["<", " ", '"', "'", "/", ">", ":", "{", "$", "("]

    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(triggers))
    async def _(params: lsp.CompletionParams) -> lsp.CompletionList | None:
        known = await server.state_of(params.text_document.uri)
        if known is None or known[1].checked is None:
            return None
        checked, columns, at = known[1].checked, server.columns, params.position
        snippets = server.takes_snippets
        return await server.read(
            lambda: completions(session, known[0], checked, at, columns, snippets=snippets)
        )
