# cmake -DCERTIFICATE=… -DHEADER=… -DSEED=… -P join_texts.cmake: writes both texts, a form feed between them.
file(READ ${CERTIFICATE} certificate)
file(READ ${HEADER} header)
string(ASCII 12 form_feed)
file(WRITE ${SEED} "${certificate}${form_feed}${header}")
