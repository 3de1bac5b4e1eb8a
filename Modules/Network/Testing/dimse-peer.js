// A DICOM node of dcmjs-dimse, an implementation of its own in JavaScript: C-ECHO, C-STORE, C-FIND
// and C-GET, also over TLS. Keeps what it gets in memory, without private attributes, which it loses.
//
// node dimse-peer.js PORT [KEY CERTIFICATE CLIENT_CERTIFICATE]     exit 77: dcmjs-dimse is not there
'use strict';
const fs = require('fs');
let dimse;
try {
  dimse = require('dcmjs-dimse');
} catch (error) {
  process.exit(77);
}
const { CEchoResponse, CFindResponse, CGetResponse, CStoreResponse } = dimse.responses;
const { CStoreRequest } = dimse.requests;
const { Status, PresentationContextResult, TransferSyntax } = dimse.constants;

const kept = new Map(); // SOP instance UID to data set
const kLevels = { STUDY: 'StudyInstanceUID', SERIES: 'SeriesInstanceUID', IMAGE: 'SOPInstanceUID' };

// Data elements of a query that select: single values, lists of UIDs, and * in text.
function matches(elements, query) {
  return Object.entries(query).every(([name, wanted]) => {
    if (name === 'QueryRetrieveLevel' || name === 'SpecificCharacterSet' || name.startsWith('_')) return true;
    const values = (Array.isArray(wanted) ? wanted : String(wanted ?? '').split('\\')).map(String).filter((v) => v);
    if (!values.length) return true;
    const key = name === 'ModalitiesInStudy' ? 'Modality' : name;
    const own = String(elements[key] ?? '');
    return values.some((value) => new RegExp('^' + value.replace(/[.+^${}()|[\]\\]/g, '\\$&')
      .replace(/\*/g, '.*').replace(/\?/g, '.') + '$').test(own));
  });
}

class Peer extends dimse.Scp {
  associationRequested(association) {
    this.association = association;
    for (const { id } of association.getPresentationContexts()) {
      const context = association.getPresentationContext(id);
      const offered = context.getTransferSyntaxUids();
      const chosen = [TransferSyntax.ExplicitVRLittleEndian, TransferSyntax.ImplicitVRLittleEndian]
        .find((one) => offered.includes(one));
      if (chosen) context.setResult(PresentationContextResult.Accept, chosen);
      else context.setResult(PresentationContextResult.RejectTransferSyntaxesNotSupported);
    }
    this.sendAssociationAccept();
  }

  cEchoRequest(request, callback) {
    const response = CEchoResponse.fromRequest(request);
    response.setStatus(Status.Success);
    callback(response);
  }

  cStoreRequest(request, callback) {
    const dataSet = request.getDataset();
    kept.set(String(dataSet.getElement('SOPInstanceUID')), dataSet);
    const response = CStoreResponse.fromRequest(request);
    response.setStatus(Status.Success);
    callback(response);
  }

  cFindRequest(request, callback) {
    const query = request.getDataset().getElements();
    const key = kLevels[query.QueryRetrieveLevel];
    const found = new Map(); // one of each study, series or instance
    for (const dataSet of kept.values())
      if (matches(dataSet.getElements(), query)) found.set(String(dataSet.getElement(key)), dataSet);
    const responses = [...found.values()].map((dataSet) => {
      const elements = dataSet.getElements();
      const answer = { QueryRetrieveLevel: query.QueryRetrieveLevel };
      for (const name of Object.keys(query))
        if (!name.startsWith('_') && name !== 'QueryRetrieveLevel')
          answer[name] = name === 'ModalitiesInStudy' ? elements.Modality : elements[name] ?? '';
      const response = CFindResponse.fromRequest(request);
      response.setDataset(new dimse.Dataset(answer));
      response.setStatus(Status.Pending);
      return response;
    });
    const last = CFindResponse.fromRequest(request);
    last.setStatus(Status.Success);
    callback([...responses, last]);
  }

  cGetRequest(request, callback) {
    const wanted = [...kept.values()].filter((one) => matches(one.getElements(), request.getDataset().getElements()));
    const counts = { completed: 0, failed: 0 };
    const end = () => {
      const response = CGetResponse.fromRequest(request);
      response.setStatus(counts.failed ? Status.ProcessingFailure : Status.Success);
      response.setCompleted(counts.completed);
      response.setFailures(counts.failed);
      response.setWarnings(0);
      response.setRemaining(0);
      callback([response]);
    };
    if (!wanted.length) return end();
    this.sendRequests(wanted.map((dataSet) => {
      const store = new CStoreRequest(dataSet);
      store.on('response', (response) => {
        counts[response.getStatus() === Status.Success ? 'completed' : 'failed'] += 1;
        if (counts.completed + counts.failed === wanted.length) end();
      });
      return store;
    }));
  }

  associationReleaseRequested() {
    this.sendAssociationReleaseResponse();
  }
}

const [port, key, certificate, client] = process.argv.slice(2);
const server = new dimse.Server(Peer);
server.on('networkError', (error) => console.log(String(error)));
const read = (file) => fs.readFileSync(file);
server.listen(Number(port), key ? { securityOptions: { key: read(key), cert: read(certificate), ca: read(client),
  requestCert: true, rejectUnauthorized: true, minVersion: 'TLSv1.2' } } : {});
