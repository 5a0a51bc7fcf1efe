# In comments #V is a number of vertices, to doxygen a link.
\|///|s/#\([^ ]\)/\\#\1/g
